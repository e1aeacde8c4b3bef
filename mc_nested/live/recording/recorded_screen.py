"""A window's screen on tape: what was asked of it and answered, and the pixels of what it read."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeVar

from mc_nested.errors import McNestedError
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.scales import Scales
from mc_nested.live.recording.tape import Tape
from mc_nested.live.vision.game_screen import Labels, WindowScreen
from mc_nested.live.vision.menu_labels import MenuButton

T = TypeVar("T")


class RecordedScreen:
    """A screen on tape. The pictures that it takes are part of its own calls.

    Only what the debug screen says comes with its pixels: the chat may hold what others said.
    """

    def __init__(self, screen: WindowScreen, tape: Tape) -> None:
        self._screen, self._tape = screen, tape

    def read(self) -> Reading:
        with self._asked("read"):
            reading = self._screen.read()
        self._tape.add("screen", "read", [], reading, self._screen.last_look)
        return reading

    def read_position(self) -> tuple[float, float, float] | None:
        with self._asked("read_position"):
            position = self._screen.read_position()
        self._tape.add("screen", "read_position", [], position, self._screen.last_look)
        return position

    def shows_world(self) -> bool:
        with self._asked("shows_world"):
            is_shown = self._screen.shows_world()
        return self._answered(is_shown, "shows_world")

    def shows_death(self) -> bool:
        with self._asked("shows_death"):
            is_shown = self._screen.shows_death()
        return self._answered(is_shown, "shows_death")

    def is_chat_open(self) -> bool:
        with self._asked("is_chat_open"):
            is_open = self._screen.is_chat_open()
        return self._answered(is_open, "is_chat_open")

    def is_typed(self, text: str) -> bool:
        with self._asked("is_typed"):
            is_typed = self._screen.is_typed(text)
        return self._answered(is_typed, "is_typed", text)

    def menu(self) -> Labels:
        with self._asked("menu"):
            labels = self._screen.menu()
        self._tape.add("screen", "menu", [], None, None)
        return RecordedLabels(labels, self._tape)

    def position_of(self, text: str) -> tuple[int, int] | None:
        with self._asked("position_of"):
            position = self._screen.position_of(text)
        return self._answered(position, "position_of", text)

    def gui_scale(self) -> int:
        with self._asked("gui_scale"):
            scale = self._screen.gui_scale()
        return self._answered(scale, "gui_scale")

    def seen_scales(self) -> Scales | None:
        with self._asked("seen_scales"):
            scales = self._screen.seen_scales()
        return self._answered(scales, "seen_scales")

    def _answered(self, answer: T, name: str, *asked: str) -> T:
        self._tape.add("screen", name, list(asked), answer, None)
        return answer

    @contextmanager
    def _asked(self, name: str) -> Iterator[None]:
        """Around a call of the screen: what it calls itself is part of it, and so is its error."""
        self._tape.inside = True
        try:
            yield
        except McNestedError as error:
            self._tape.inside = False
            self._tape.add("error", name, type(error).__name__, str(error))
            raise
        finally:
            self._tape.inside = False


class RecordedLabels:
    """A menu on tape."""

    def __init__(self, labels: Labels, tape: Tape) -> None:
        self._labels, self._tape = labels, tape

    def shows(self, text: str) -> bool:
        shows = self._labels.shows(text)
        self._tape.add("menu", "shows", text, shows)
        return shows

    def button(self, label: str) -> MenuButton:
        button = self._labels.button(label)
        self._tape.add("menu", "button", label, button)
        return button
