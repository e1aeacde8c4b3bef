"""A real window of SDL 3, made as the game's own is from 26.3 on, that notes what reaches it and does what it is told.

usage: sdl3_window.py LIBRARY PORT TITLE, as window_server.py has it; LIBRARY is SDL 3's shared library. It runs
wherever SDL 3 does, under Wine too. Keys have the names of their scancodes.
"""

import ctypes
import struct
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

sys.path.insert(0, str(Path(__file__).parents[4]))  # a Windows Python that was only unpacked knows no PYTHONPATH

from tests.live.desktop.real_windows.window_server import Event, serve

if TYPE_CHECKING:
    from collections.abc import Callable

SIZE = (320, 240)
LOOK_S = 0.004
_VIDEO = 0x20
_FOCUS_GAINED, _FOCUS_LOST, _KEY_DOWN, _KEY_UP, _TEXT = 0x20E, 0x20F, 0x300, 0x301, 0x303
_MOTION, _BUTTON_DOWN, _BUTTON_UP = 0x400, 0x401, 0x402
_HAS_FOCUS = 0x200
"""SDL_WINDOW_INPUT_FOCUS."""


class SdlWindow:
    """The window, and its events since they were last asked for. Text comes once it is told to take some."""

    def __init__(self, library: str, title: str) -> None:
        sdl = self._sdl = ctypes.CDLL(library)
        sdl.SDL_CreateWindow.restype = ctypes.c_void_p
        sdl.SDL_CreateWindow.argtypes = (ctypes.c_char_p, ctypes.c_int, ctypes.c_int, ctypes.c_uint64)
        sdl.SDL_GetError.restype = sdl.SDL_GetScancodeName.restype = ctypes.c_char_p
        sdl.SDL_GetWindowFlags.restype = ctypes.c_uint64
        for call in (sdl.SDL_StartTextInput, sdl.SDL_RaiseWindow, sdl.SDL_GetWindowFlags, sdl.SDL_SyncWindow):
            call.argtypes = (ctypes.c_void_p,)
        sdl.SDL_SetWindowRelativeMouseMode.argtypes = (ctypes.c_void_p, ctypes.c_bool)
        sdl.SDL_SetWindowRelativeMouseMode.restype = sdl.SDL_PollEvent.restype = sdl.SDL_Init.restype = ctypes.c_bool
        window = sdl.SDL_CreateWindow(title.encode(), *SIZE, 0) if sdl.SDL_Init(_VIDEO) else None
        if not window:
            raise SystemExit(f"SDL opens no window: {sdl.SDL_GetError().decode()}")
        self._event = ctypes.create_string_buffer(256)
        self._events: list[Event] = []
        self.commands: dict[str, Callable[..., Any]] = {
            "events": self._taken_events,
            "take text": lambda: bool(sdl.SDL_StartTextInput(window)),
            "focus": lambda: bool(sdl.SDL_RaiseWindow(window)),
            "grab cursor": lambda: bool(sdl.SDL_SetWindowRelativeMouseMode(window, True)),
            "free cursor": lambda: bool(sdl.SDL_SetWindowRelativeMouseMode(window, False)),
            "state": lambda: {"has focus": bool(sdl.SDL_GetWindowFlags(window) & _HAS_FOCUS)},
            "version": sdl.SDL_GetVersion,
        }

    def step(self) -> None:
        """Take the events that have come."""
        while self._sdl.SDL_PollEvent(self._event):
            self._note(struct.unpack_from("I", self._event)[0])
        time.sleep(LOOK_S)

    def _taken_events(self) -> list[Event]:
        """Return those of all input until now: an X server sends events in order, and SDL takes all that are there."""
        self.step()
        self.step()
        taken = list(self._events)
        self._events.clear()
        return taken

    def _note(self, kind: int) -> None:
        """Note an event.

        Offsets are those of SDL_events.h: a type, a timestamp, the window and the device come first.
        """
        event, note = self._event, self._events.append
        if kind in (_KEY_DOWN, _KEY_UP):
            scancode, _, _, _, is_down, is_again = struct.unpack_from("IIHHBB", event, 24)
            name = self._sdl.SDL_GetScancodeName(scancode).decode()
            note(["key", name, scancode, 2 if is_again else is_down])
        elif kind == _TEXT:
            text = ctypes.string_at(struct.unpack_from("P", event, 24)[0]).decode()
            for character in text:
                note(["char", ord(character)])
        elif kind == _MOTION:
            note(["cursor", *struct.unpack_from("ff", event, 28)])
        elif kind in (_BUTTON_DOWN, _BUTTON_UP):
            note(["button", *struct.unpack_from("BB", event, 24)])
        elif kind in (_FOCUS_GAINED, _FOCUS_LOST):
            note(["focus", int(kind == _FOCUS_GAINED)])


def main(library: str, port: int, title: str) -> None:
    serve(SdlWindow(library, title), port)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
