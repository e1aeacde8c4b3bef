"""Text on an X server: through pynput where the layout has the character, else on a spare key; nothing stays down."""

import sys
from types import SimpleNamespace
from typing import Any

import pytest

from mc_nested.errors import DesktopError

if not sys.platform.startswith("linux"):
    pytest.skip("keys of an X server", allow_module_level=True)

from Xlib import X

from mc_nested.live.desktop.x11_spare_keys import STATES, SpareKeys
from tests.live.desktop.fake_devices import X11Error, install_pynput, reloaded
from tests.live.desktop.fake_x_display import FakeXDisplay


class Typist:
    """pynput's controller, over a layout that has two letters."""

    def __init__(self) -> None:
        self.keyboard_mapping = {ord("t"): (28, 0), ord("p"): (33, 0)}
        self.sent: list[tuple[str, str]] = []
        self.is_interrupted = False
        self.is_window_gone = False

    def press(self, character: str) -> None:
        self.sent.append(("press", character))
        if self.is_interrupted:
            raise KeyboardInterrupt
        if self.is_window_gone:
            raise X11Error("BadWindow")

    def release(self, character: str) -> None:
        self.sent.append(("release", character))
        if self.is_window_gone:
            raise X11Error("BadWindow")


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Any:
    install_pynput(monkeypatch)
    return reloaded("mc_nested.live.desktop.x11_keyboard", monkeypatch)


def sender_of(module: Any, display: FakeXDisplay) -> tuple[Any, Typist]:
    typist = Typist()
    return module.X11KeySender(display, SpareKeys(display), typist), typist  # type: ignore[arg-type]  # as much as is used


def test_a_letter_of_the_layout_is_typed_by_pynput_and_leaves_the_layout_alone(module: Any) -> None:
    display = FakeXDisplay(spare=20)
    sender, typist = sender_of(module, display)
    sender.type("t")
    assert typist.sent == [("press", "t"), ("release", "t")]
    assert display.changed == {}


def test_a_window_that_closes_during_typing_is_a_one_line_error(module: Any) -> None:
    sender, typist = sender_of(module, FakeXDisplay(spare=20))
    typist.is_window_gone = True
    with pytest.raises(DesktopError, match="the window that was typed into has closed: start the game again"):
        sender.type("t")


def test_a_letter_interrupted_after_its_press_is_released(module: Any) -> None:
    sender, typist = sender_of(module, FakeXDisplay(spare=20))
    typist.is_interrupted = True
    with pytest.raises(KeyboardInterrupt):
        sender.type("t")
    assert typist.sent == [("press", "t"), ("release", "t")]


def test_a_letter_that_the_layout_lacks_is_typed_on_a_spare_key(module: Any) -> None:
    display = FakeXDisplay(spare=25)
    sender, typist = sender_of(module, display)
    sender.type("~")
    (press, release) = display.window.events
    assert (press.type, release.type) == (X.KeyPress, X.KeyRelease)
    for event in (press, release):
        assert display.changed[event.detail][STATES.index(event.state)] == ord("~")
        assert event.window is display.window
    assert typist.sent == []


def test_the_spare_keys_are_changed_only_once_for_all_letters(module: Any) -> None:
    display = FakeXDisplay(spare=25)
    sender, _ = sender_of(module, display)
    sender.type("~")
    changes = display.changes
    sender.type("a")
    assert changes == display.changes


def test_a_letter_without_a_spare_key_is_refused_and_nothing_is_typed(module: Any) -> None:
    display = FakeXDisplay(spare=1)
    sender, typist = sender_of(module, display)
    for character in ("~", "木"):
        with pytest.raises(DesktopError, match=f"'{character}' can't be typed with this keyboard layout"):
            sender.type(character)
    assert (typist.sent, display.window.events) == ([], [])


def test_nothing_is_typed_on_a_spare_key_while_no_window_has_the_focus(module: Any) -> None:
    display = FakeXDisplay(spare=25)
    sender, _ = sender_of(module, display)
    display.get_input_focus = lambda: SimpleNamespace(focus=X.PointerRoot)  # type: ignore[method-assign]
    with pytest.raises(DesktopError, match="no window has the keyboard"):
        sender.type("~")
