"""Keys and text on an X server: keys by keycode through XTEST, text by the keyboard's layout through pynput."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any

from pynput._util.xorg import X11Error  # type: ignore[import-not-found]  # pynput raises it, and has it nowhere else
from pynput.keyboard import Controller
from Xlib import X
from Xlib.display import Display
from Xlib.error import ConnectionClosedError
from Xlib.ext import xtest
from Xlib.protocol import event

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.x11_spare_keys import SpareKeys
from mc_nested.live.model.keys import CHARACTERS, PLACES, KeyPlace, Layout

EVDEV_TO_KEYCODE = 8
"""What an X server's keycode is more than evdev's code, as GLFW and every layout file for evdev take it."""

_LWJGL_2 = {
    **{ord(character): character for character in (*(CHARACTERS - {"\\"}), *"@:^_")},
    **{ord(letter.upper()): letter for letter in CHARACTERS if letter.isalpha()},
}
"""The keys that LWJGL 2 takes keysyms for, as far as keys of characters have them: no backslash (its LinuxKeycodes).

It also has a dead grave and a dead circumflex, but never gets them: the input method waits for the next letter."""

_CHARACTER_KEYCODES = {name: PLACES[name].evdev + EVDEV_TO_KEYCODE for name in CHARACTERS}
_FIRST, _LAST = min(_CHARACTER_KEYCODES.values()), max(_CHARACTER_KEYCODES.values())

_Kind = type[event.KeyPress] | type[event.KeyRelease]

_ASCII = range(0x20, 0x7F)
"""The keysyms of ASCII's characters, which commands are written in: their own numbers."""

_UNICODE_KEYSYM = 0x01000000
"""Added to the number of a character that isn't in Latin 1, in its keysym (X11 protocol, appendix A)."""


class X11KeySender:
    """Sends keys as the keyboard's own, over a connection of its own.

    Text goes another way: events without a time, made for the window in front, by pynput where the layout has the
    character, and else on a spare key. GLFW takes their characters, and may drop the keys in them; so a key is never
    sent that way (FACTS: Input and windows).
    """

    def __init__(self, display: Display, spare: SpareKeys, typist: Any) -> None:
        self._display = display
        self._spare = spare
        self._spare_keys: Mapping[int, tuple[int, int]] | None = None
        self._typist = typist
        self._layout: Layout | None = None

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        xtest.fake_input(self._display, X.KeyPress if is_down else X.KeyRelease, place.evdev + EVDEV_TO_KEYCODE)
        self._display.sync()

    def layout(self) -> Layout:
        """Return what LWJGL 2 takes each key for, by the layout's first group, whichever group is in use."""
        while self._display.pending_events():
            if self._display.next_event().type == X.MappingNotify:
                self._layout = None
        if self._layout is None:
            rows = self._display.get_keyboard_mapping(_FIRST, _LAST - _FIRST + 1)
            self._layout = {
                name: (_LWJGL_2.get(rows[code - _FIRST][0], ""), _LWJGL_2.get(rows[code - _FIRST][1], ""))
                for name, code in _CHARACTER_KEYCODES.items()
            }
        return self._layout

    def type(self, character: str) -> None:
        # pynput has spare keys of its own, but takes one for several characters: the window then writes another one.
        if (keysym := _keysym(character)) in self._typist.keyboard_mapping:
            self._type_by_layout(character)
        elif key := self._spare_key(keysym):
            try:
                self._write(event.KeyPress, *key)
            finally:
                self._write(event.KeyRelease, *key)
        else:
            raise DesktopError(f"{character!r} can't be typed with this keyboard layout: switch to a Latin one")

    def _type_by_layout(self, character: str) -> None:
        try:
            try:
                self._typist.press(character)
            finally:
                self._typist.release(character)
        except X11Error as error:  # the window in front is gone between its being asked for and being written to
            raise DesktopError("the window that was typed into has closed: start the game again") from error

    def _spare_key(self, keysym: int) -> tuple[int, int] | None:
        if self._spare_keys is None:
            layout = self._typist.keyboard_mapping
            self._spare_keys = self._spare.lend([each for each in _ASCII if each not in layout])
        return self._spare_keys.get(keysym)

    def _write(self, kind: _Kind, keycode: int, state: int) -> None:
        window, root = self._display.get_input_focus().focus, self._display.screen().root
        if isinstance(window, int):  # the focus is on no window of its own
            raise DesktopError("no window has the keyboard: switch to the game")
        window.send_event(
            kind(
                detail=keycode,
                state=state,
                time=X.CurrentTime,
                root=root,
                window=window,
                same_screen=1,
                child=X.NONE,
                root_x=0,
                root_y=0,
                event_x=0,
                event_y=0,
            )
        )
        self._display.sync()


@contextmanager
def open_sender() -> Iterator[X11KeySender]:
    """Yield the keys of the display in DISPLAY."""
    display = Display()
    spare = SpareKeys(display)
    try:
        yield X11KeySender(display, spare, Controller())
    finally:
        with suppress(ConnectionClosedError):  # the X server may have ended first
            spare.close()
            display.close()


def _keysym(character: str) -> int:
    number = ord(character)
    return number if number < 0x100 else _UNICODE_KEYSYM | number
