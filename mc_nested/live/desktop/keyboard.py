"""The real keyboard: keys by their places, text by its characters. How both are sent is each system's own.

A game to 1.12 takes a key by the symbol that it makes: then it is pressed where the layout has that symbol.
"""

import sys
from collections.abc import Collection, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from typing import Protocol

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.lost_display import LOST, raise_when_display_lost
from mc_nested.live.model.keys import PLACES, SHIFT, KeyPlace, Layout, missing_keys, place_of, stroke_for


class KeySender(Protocol):
    """Sends keys and characters to whatever window is in front."""

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        """Send that the key at a place goes down or up."""

    def type(self, character: str) -> None:
        """Write a character, and hold nothing afterwards. Raise DesktopError where this desktop has no way to."""

    def layout(self) -> Layout | None:
        """Return what LWJGL 2 takes each key for, as the keyboard's layout is now.

        Return None where it goes by places, too.
        """


class DesktopKeyboard:
    """Presses keys into whatever window is in front; the caller checks which window that is.

    Raises (every method): ProfileError for a name that no key has; a press and text also DesktopError, for a character
    that this keyboard's layout lacks, and where the display has closed.
    """

    def __init__(self, sender: KeySender) -> None:
        self._sender = sender
        self._goes_by_symbols = False
        self._down: dict[str, list[KeyPlace]] = {}

    def go_by_symbols(self, keys: Collection[str]) -> None:
        self._goes_by_symbols = True
        with raise_when_display_lost():
            layout = self._sender.layout()
        if layout is not None and (missing := missing_keys(keys, layout)):
            raise _lacking(missing)

    def press(self, key: str) -> None:
        with raise_when_display_lost():
            places = self._places(key)
            if not places:
                raise _lacking([key])
            self._down[key] = places
            for place in places:
                self._sender.send(place, is_down=True)

    def release(self, key: str) -> None:
        with suppress(*LOST):
            # As it was pressed. Shift last: a key that goes up without it is another one, and the first stays down.
            for place in reversed(self._down.pop(key, []) or self._places(key)):
                self._sender.send(place, is_down=False)

    def type(self, text: str) -> None:
        with raise_when_display_lost():
            for character in text:
                self._sender.type(character)

    def _places(self, key: str) -> list[KeyPlace]:
        """Return what is pressed for a key, in order, as the keyboard's layout is now.

        Return none where it lacks the symbol.
        """
        place = place_of(key)
        layout = self._sender.layout() if self._goes_by_symbols else None
        if layout is None:
            return [place]
        stroke = stroke_for(key, layout)
        if stroke is None:
            return []
        return [*([PLACES[SHIFT]] if stroke.takes_shift else []), PLACES[stroke.place]]


@contextmanager
def open_keyboard() -> Iterator[DesktopKeyboard]:
    """Yield the keyboard of this desktop. Needs a display: open the window first."""
    with _open_sender() as sender:
        yield DesktopKeyboard(sender)


def _open_sender() -> AbstractContextManager[KeySender]:
    if sys.platform == "win32":
        from mc_nested.live.desktop.win32_keyboard import Win32KeySender

        return nullcontext(Win32KeySender())
    if sys.platform == "darwin":
        from pynput.keyboard import Controller

        from mc_nested.live.desktop.quartz_keyboard import QuartzKeySender

        return nullcontext(QuartzKeySender(Controller()))
    from mc_nested.live.desktop.x11_keyboard import open_sender

    return open_sender()


def _lacking(keys: list[str]) -> DesktopError:
    return DesktopError(
        f"Minecraft to 1.12 goes by what a key types, and this keyboard layout types no {', '.join(keys)}: "
        "switch to English (US), on Linux as the first of your layouts, and start again"
    )
