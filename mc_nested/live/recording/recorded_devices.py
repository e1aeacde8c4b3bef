"""The devices and the screen of a window that add each call to a tape, with the pixels of what was read.

What a clipboard holds is not.
"""

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from typing import Generic, ParamSpec, TypeVar

from mc_nested.errors import McNestedError
from mc_nested.live.devices import Button, Clipboard, Clock, Devices, Display, Frame, Keyboard, Pointer, Region
from mc_nested.live.model.reading import Reading
from mc_nested.live.recording.format import Tape
from mc_nested.live.vision.game_screen import Labels, WindowScreen
from mc_nested.live.vision.layout import Scales
from mc_nested.live.vision.menu_labels import MenuButton

Device = TypeVar("Device")
Answer = TypeVar("Answer")
Asked = ParamSpec("Asked")


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


class _OnTape(Generic[Device]):
    """A device, a screen or a menu, and the tape that its calls are added to."""

    def __init__(self, device: Device, tape: Tape) -> None:
        self._device, self._tape = device, tape

    def _ask(self, name: str, ask: Callable[[], Answer]) -> Answer:
        """Ask the device, then record its answer or its error."""
        with failures_on(self._tape, name):
            answer = ask()
        self._tape.add(name, answer)
        return answer

    def _tell(self, name: str, what: str, do: Callable[Asked, None], *args: Asked.args, **kwargs: Asked.kwargs) -> None:
        """Record what the device is to do, then let it do that, and record its error."""
        self._tape.add(name, what, *args)
        with failures_on(self._tape, name):
            do(*args, **kwargs)


class RecordedClock(_OnTape[Clock]):
    """A clock on tape."""

    def now(self) -> float:
        now = self._device.now()
        self._tape.add("now", now)
        return now

    def sleep_until(self, at: float) -> None:
        self._tape.add("sleep", at)
        self._device.sleep_until(at)


class RecordedDisplay(_OnTape[Display]):
    """A display on tape."""

    def size(self) -> tuple[int, int]:
        return self._ask("size", self._device.size)

    def title(self) -> str:
        return self._ask("title", self._device.title)

    def is_in_front(self) -> bool:
        return self._ask("front", self._device.is_in_front)

    def grab(self, region: Region | None = None) -> Frame:
        with failures_on(self._tape, "grab"):
            frame = self._device.grab(region)
        self._tape.add("grab", region, frame)
        return frame


class RecordedKeyboard(_OnTape[Keyboard]):
    """A keyboard on tape."""

    def go_by_symbols(self, keys: Collection[str]) -> None:
        self._device.go_by_symbols(keys)

    def press(self, key: str) -> None:
        self._tell("key", "press", self._device.press, key)

    def release(self, key: str) -> None:
        self._tell("key", "release", self._device.release, key)

    def type(self, text: str) -> None:
        self._tell("key", "type", self._device.type, text)


class RecordedPointer(_OnTape[Pointer]):
    """A pointer on tape."""

    def position(self) -> tuple[int, int]:
        return self._ask("position", self._device.position)

    def move(self, x: int, y: int) -> None:
        self._tell("mouse", "move", self._device.move, x, y)

    def press(self, button: Button) -> None:
        self._tell("mouse", "press", self._device.press, button)

    def release(self, button: Button) -> None:
        self._tell("mouse", "release", self._device.release, button)


class RecordedClipboard(_OnTape[Clipboard]):
    """A clipboard of which only the calls are on tape: what it holds is the person's own."""

    def read(self) -> str:
        with failures_on(self._tape, "clipboard"):
            text = self._device.read()
        self._tape.add("clipboard", "read")
        return text

    def write(self, text: str) -> None:
        self._tape.add("clipboard", "write")
        with failures_on(self._tape, "clipboard"):
            self._device.write(text)


_LOOKS = ("read", "read_position")
"""Questions whose pixels are recorded."""


class RecordedScreen(_OnTape[WindowScreen]):
    """A screen on tape. The pictures that it takes are part of its own calls.

    Only what the debug screen says comes with its pixels: the chat may hold what others said.
    """

    def read(self) -> Reading:
        return self._answer("read", self._device.read)

    def read_position(self) -> tuple[float, float, float] | None:
        return self._answer("read_position", self._device.read_position)

    def shows_world(self) -> bool:
        return self._answer("shows_world", self._device.shows_world)

    def shows_death(self) -> bool:
        return self._answer("shows_death", self._device.shows_death)

    def is_chat_open(self) -> bool:
        return self._answer("is_chat_open", self._device.is_chat_open)

    def is_typed(self, text: str) -> bool:
        return self._answer("is_typed", self._device.is_typed, text)

    def menu(self) -> Labels:
        with self._asked("menu"):
            labels = self._device.menu()
        self._tape.add("screen", "menu", [], None, None)
        return RecordedLabels(labels, self._tape)

    def position_of(self, text: str) -> tuple[int, int] | None:
        return self._answer("position_of", self._device.position_of, text)

    def gui_scale(self) -> int:
        return self._answer("gui_scale", self._device.gui_scale)

    def seen_scales(self) -> Scales | None:
        return self._answer("seen_scales", self._device.seen_scales)

    def _answer(self, name: str, ask: Callable[Asked, Answer], *args: Asked.args, **kwargs: Asked.kwargs) -> Answer:
        with self._asked(name):
            answer = ask(*args, **kwargs)
        self._tape.add("screen", name, list(args), answer, self._device.last_look if name in _LOOKS else None)
        return answer

    @contextmanager
    def _asked(self, name: str) -> Iterator[None]:
        """Wrap a call of the screen: the calls that it makes itself are part of it, and so is its error."""
        with failures_on(self._tape, name):
            self._tape.inside = True
            try:
                yield
            finally:
                self._tape.inside = False


class RecordedLabels(_OnTape[Labels]):
    """A menu on tape."""

    def shows(self, text: str) -> bool:
        shows = self._device.shows(text)
        self._tape.add("menu", "shows", text, shows)
        return shows

    def button(self, label: str) -> MenuButton:
        button = self._device.button(label)
        self._tape.add("menu", "button", label, button)
        return button
