"""Recording: what a run hands its devices, screens and notes to; and the one that keeps nothing."""

from collections.abc import Callable
from typing import Protocol

from mc_nested.live.devices import Devices
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.live.vision.game_screen import GameScreen

Stop = Callable[[str], None]


class Recording(Protocol):
    """Is put between a run and its window. It is a journal, too."""

    def devices(self, devices: Devices) -> Devices:
        """The same devices, recorded."""

    def screen(self, screen: GameScreen) -> GameScreen:
        """The same screen, recorded."""

    def stopping(self, stop: Stop) -> Stop:
        """What stops the run by a person's will, recorded."""

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Set down a note of the journal."""


class NoRecording:
    """Puts nothing between them."""

    def devices(self, devices: Devices) -> Devices:
        return devices

    def screen(self, screen: GameScreen) -> GameScreen:
        return screen

    def stopping(self, stop: Stop) -> Stop:
        return stop

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Do nothing."""
