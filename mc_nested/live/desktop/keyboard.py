"""The real keyboard: keys by their places, text by its characters. How both are sent is each system's own."""

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Protocol

from mc_nested.live.desktop.lost_display import LOST, raise_when_display_lost
from mc_nested.live.model.key_names import place_of
from mc_nested.live.model.key_places import KeyPlace


class KeySender(Protocol):
    """Sends keys and characters to whatever window is in front."""

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        """The key at a place goes down or up."""

    def type(self, character: str) -> None:
        """Write a character, and hold nothing afterwards. DesktopError where this desktop has no way to."""


class DesktopKeyboard:
    """Presses keys into whatever window is in front; the caller checks which window that is.

    Raises (every method): ProfileError for a name that no key has; a press and text also DesktopError, for a character
    that this keyboard's layout lacks, and where the display has closed.
    """

    def __init__(self, sender: KeySender) -> None:
        self._sender = sender

    def press(self, key: str) -> None:
        place = place_of(key)
        with raise_when_display_lost():
            self._sender.send(place, is_down=True)

    def release(self, key: str) -> None:
        place = place_of(key)
        with suppress(*LOST):
            self._sender.send(place, is_down=False)

    def type(self, text: str) -> None:
        with raise_when_display_lost():
            for character in text:
                self._sender.type(character)


@contextmanager
def open_keyboard() -> Iterator[DesktopKeyboard]:
    """The keyboard of this desktop. Needs a display: open the window first."""
    with _open_sender() as sender:
        yield DesktopKeyboard(sender)


def _open_sender() -> AbstractContextManager[KeySender]:
    if sys.platform == "win32":
        from mc_nested.live.desktop.win32_keyboard import open_sender
    elif sys.platform == "darwin":
        from mc_nested.live.desktop.quartz_keyboard import open_sender
    else:
        from mc_nested.live.desktop.x11_keyboard import open_sender
    return open_sender()
