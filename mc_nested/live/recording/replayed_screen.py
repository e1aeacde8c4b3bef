"""The screen of a recording: readings are taken anew from its pixels, what the chat and menus showed is as recorded."""

from collections.abc import Callable
from typing import Any

from mc_nested.live.model.reading import Reading
from mc_nested.live.model.scales import Scales
from mc_nested.live.recording.pixel_reader import PixelReader
from mc_nested.live.recording.plain_values import button_of, plain, position_of, reading_of
from mc_nested.live.recording.replayed_tape import ReplayedTape
from mc_nested.live.vision.game_screen import Labels
from mc_nested.live.vision.menu_labels import MenuButton


class ReplayedScreen:
    """A screen that answers as it did, whatever is read now: so the run can be followed on.

    Args:
        tape: the calls.
        pixels: reads them anew.
        on_reading: is told what was read then and what is read now, as plain values, None where the pixels are not
            there.
    """

    def __init__(self, tape: ReplayedTape, pixels: PixelReader, on_reading: Callable[[Any, Any | None], None]) -> None:
        self._tape, self._pixels, self._on_reading = tape, pixels, on_reading

    def read(self) -> Reading:
        then, pixels = self._tape.same("screen", "read", [])
        self.read_again("read", then, pixels)
        return reading_of(then)

    def read_position(self) -> tuple[float, float, float] | None:
        then, pixels = self._tape.same("screen", "read_position", [])
        self.read_again("read_position", then, pixels)
        return position_of(then)

    def read_again(self, name: str, then: Any, pixels: Any) -> None:
        """Read the pixels of a recorded call anew, and report both readings."""
        screen = self._pixels.shown(pixels)
        if screen is None:
            self._on_reading([then], None)
        elif name == "read":
            self._on_reading([then], [plain(screen.read())])
        else:
            # A quick look reads nothing where the reading before it didn't say where: that one differs then, not this.
            position = screen.read_position()
            self._on_reading([then], None if position is None else [plain(position)])

    def shows_world(self) -> bool:
        return bool(self._answer("shows_world"))

    def shows_death(self) -> bool:
        return bool(self._answer("shows_death"))

    def is_chat_open(self) -> bool:
        return bool(self._answer("is_chat_open"))

    def is_typed(self, text: str) -> bool:
        return bool(self._answer("is_typed", text))

    def menu(self) -> Labels:
        self._answer("menu")
        return _Labels(self._tape)

    def position_of(self, text: str) -> tuple[int, int] | None:
        position = self._answer("position_of", text)
        return None if position is None else (int(position[0]), int(position[1]))

    def gui_scale(self) -> int:
        return int(self._answer("gui_scale"))

    def seen_scales(self) -> Scales | None:
        if not self._tape.is_followed:
            return None
        scales = self._answer("seen_scales")
        return None if scales is None else Scales(*map(int, scales))

    def _answer(self, name: str, *asked: str) -> Any:
        return self._tape.same("screen", name, list(asked))[0]


class _Labels:
    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape

    def shows(self, text: str) -> bool:
        return bool(self._tape.same("menu", "shows", text)[0])

    def button(self, label: str) -> MenuButton:
        return button_of(self._tape.same("menu", "button", label)[0])
