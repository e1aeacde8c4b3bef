"""The devices and the screen of a window that add each call to a tape, with the pixels of what was read.

What a clipboard holds is not.
"""

from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import TypeVar

from mc_nested.errors import McNestedError
from mc_nested.live.devices import (
    Button,
    Clipboard,
    Clock,
    Devices,
    Display,
    Frame,
    Keyboard,
    Pointer,
    Region,
)
from mc_nested.live.model.reading import Reading
from mc_nested.live.recording.tape import Tape
from mc_nested.live.vision.game_screen import Labels, WindowScreen
from mc_nested.live.vision.layout import Scales
from mc_nested.live.vision.menu_labels import MenuButton


def recorded(devices: Devices, tape: Tape) -> Devices:
    """Return the same devices, on tape."""
    return Devices(
        RecordedDisplay(devices.display, tape),
        RecordedKeyboard(devices.keyboard, tape),
        RecordedPointer(devices.pointer, tape),
        RecordedClock(devices.clock, tape),
        RecordedClipboard(devices.clipboard, tape),
        devices.area,
        devices.monitors,
    )


@contextmanager
def failures_on(tape: Tape, name: str) -> Iterator[None]:
    """Record an error of a device, and raise it unchanged."""
    try:
        yield
    except McNestedError as error:
        tape.add("error", name, type(error).__name__, str(error))
        raise


class RecordedClock:
    """A clock on tape."""

    def __init__(self, clock: Clock, tape: Tape) -> None:
        self._clock, self._tape = clock, tape

    def now(self) -> float:
        now = self._clock.now()
        self._tape.add("now", now)
        return now

    def sleep_until(self, at: float) -> None:
        self._tape.add("sleep", at)
        self._clock.sleep_until(at)


class RecordedDisplay:
    """A display on tape."""

    def __init__(self, display: Display, tape: Tape) -> None:
        self._display, self._tape = display, tape

    def size(self) -> tuple[int, int]:
        with failures_on(self._tape, "size"):
            size = self._display.size()
        self._tape.add("size", size)
        return size

    def title(self) -> str:
        with failures_on(self._tape, "title"):
            title = self._display.title()
        self._tape.add("title", title)
        return title

    def is_in_front(self) -> bool:
        with failures_on(self._tape, "front"):
            is_in_front = self._display.is_in_front()
        self._tape.add("front", is_in_front)
        return is_in_front

    def grab(self, region: Region | None = None) -> Frame:
        with failures_on(self._tape, "grab"):
            frame = self._display.grab(region)
        self._tape.add("grab", region, frame)
        return frame


class RecordedKeyboard:
    """A keyboard on tape."""

    def __init__(self, keyboard: Keyboard, tape: Tape) -> None:
        self._keyboard, self._tape = keyboard, tape

    def go_by_symbols(self, keys: Collection[str]) -> None:
        self._keyboard.go_by_symbols(keys)

    def press(self, key: str) -> None:
        self._tape.add("key", "press", key)
        with failures_on(self._tape, "key"):
            self._keyboard.press(key)

    def release(self, key: str) -> None:
        self._tape.add("key", "release", key)
        with failures_on(self._tape, "key"):
            self._keyboard.release(key)

    def type(self, text: str) -> None:
        self._tape.add("key", "type", text)
        with failures_on(self._tape, "key"):
            self._keyboard.type(text)


class RecordedPointer:
    """A pointer on tape."""

    def __init__(self, pointer: Pointer, tape: Tape) -> None:
        self._pointer, self._tape = pointer, tape

    def position(self) -> tuple[int, int]:
        with failures_on(self._tape, "position"):
            position = self._pointer.position()
        self._tape.add("position", position)
        return position

    def move(self, x: int, y: int) -> None:
        self._tape.add("mouse", "move", x, y)
        with failures_on(self._tape, "mouse"):
            self._pointer.move(x, y)

    def press(self, button: Button) -> None:
        self._tape.add("mouse", "press", button)
        with failures_on(self._tape, "mouse"):
            self._pointer.press(button)

    def release(self, button: Button) -> None:
        self._tape.add("mouse", "release", button)
        with failures_on(self._tape, "mouse"):
            self._pointer.release(button)


class RecordedClipboard:
    """A clipboard of which only the calls are on tape: what it holds is the person's own."""

    def __init__(self, clipboard: Clipboard, tape: Tape) -> None:
        self._clipboard, self._tape = clipboard, tape

    def read(self) -> str:
        with failures_on(self._tape, "clipboard"):
            text = self._clipboard.read()
        self._tape.add("clipboard", "read")
        return text

    def write(self, text: str) -> None:
        self._tape.add("clipboard", "write")
        with failures_on(self._tape, "clipboard"):
            self._clipboard.write(text)


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
        """Wrap a call of the screen: the calls that it makes itself are part of it, and so is its error."""
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
