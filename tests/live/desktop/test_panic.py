"""The panic switch: on a made-up keyboard and mouse, and on real ones under Xvfb."""

import pytest

from mc_nested.errors import ProfileError
from mc_nested.live.desktop.key_listener import CLOSE_S
from mc_nested.live.desktop.panic import open_panic_switch, open_takeover_key
from mc_nested.live.input.stops import CORNER_REASON, KEY_REASON
from tests.live.desktop.fake_devices import Listener, Mouse, install_mouse, install_pynput
from tests.live.desktop.real_windows.heard_keys import HeardKeys
from tests.live.desktop.real_windows.probed import probed


@pytest.fixture
def mouse(monkeypatch: pytest.MonkeyPatch) -> Mouse:
    """Return a mouse over a screen of 1024 x 768."""
    return install_mouse(monkeypatch)


@pytest.fixture
def moves(mouse: Mouse, monkeypatch: pytest.MonkeyPatch) -> list[Listener]:  # noqa: ARG001 - the mouse that is asked
    """Return the listeners of the mouse."""
    return install_pynput(monkeypatch)[1]


@pytest.mark.usefixtures("moves")
@pytest.mark.parametrize(
    ("name", "heard"), [("f12", "f12"), ("left.shift", "left.shift"), ("P", "p"), ("escape", "esc")]
)
def test_the_panic_key_stops_as_soon_as_it_goes_down(name: str, heard: str) -> None:
    keys, stopped = HeardKeys(), list[str]()
    with open_panic_switch(name, stopped.append, keys.listening):
        keys.press(heard)
        assert stopped == [KEY_REASON]
        keys.release(heard)
    assert stopped == [KEY_REASON]


@pytest.mark.usefixtures("moves")
def test_no_key_except_the_panic_key_stops() -> None:
    keys, stopped = HeardKeys(), list[str]()
    with open_panic_switch("f12", stopped.append, keys.listening):
        for name in ("f11", "w", "left.shift"):
            keys.press(name)
    assert stopped == []


def test_moving_the_mouse_into_any_corner_stops_and_elsewhere_does_not(moves: list[Listener]) -> None:
    stopped: list[str] = []
    outside_or_beside = ((1, 0), (0, 1), (1024, 768), (1022, 767), (512, 0))
    with open_panic_switch("f12", stopped.append, HeardKeys().listening):
        move = moves[0].heard["on_move"]
        for x, y in outside_or_beside:
            move(x, y)
        assert stopped == []
        for left, top in ((0.0, 0.0), (1023.0, 0.0), (0.0, 767.0), (1023.99, 767.99)):
            move(left, top)
    assert stopped == [CORNER_REASON] * 4


def test_a_move_reported_beyond_the_edge_stops_only_if_the_mouse_is_in_a_corner(
    moves: list[Listener], mouse: Mouse
) -> None:
    stopped: list[str] = []
    with open_panic_switch("f12", stopped.append, HeardKeys().listening):
        move = moves[0].heard["on_move"]
        move(-15, -15)
        assert stopped == []
        mouse.at = (0, 0)
        move(-15, -15)
        assert stopped == [CORNER_REASON]
        mouse.at = (0, 300)
        move(-15, 300)
    assert stopped == [CORNER_REASON]


def test_leaving_the_context_stops_the_panic_switch_and_joins_its_listeners(
    moves: list[Listener],
) -> None:
    keys = HeardKeys()
    with open_panic_switch("f12", lambda _: None, keys.listening):
        assert keys.is_listening
        assert moves[0].is_alive()
    assert not keys.is_listening
    assert not moves[0].is_alive()
    assert moves[0].joined == [CLOSE_S]


def test_an_unknown_panic_key_is_refused_before_anything_listens(moves: list[Listener]) -> None:
    with pytest.raises(ProfileError, match="no key is named 'shift'"), open_panic_switch("shift", lambda _: None):
        pass
    assert moves == []


@pytest.mark.standin
def test_a_real_key_and_a_real_mouse_stop_within_a_tenth_of_a_second(x_server: dict[str, str]) -> None:
    report = probed(x_server, "panic")
    assert [reason for reason, _ in report["stopped by"]] == [KEY_REASON, CORNER_REASON, CORNER_REASON]
    assert max(seconds for _, seconds in report["stopped by"]) <= 0.1


def test_the_takeover_key_switches_once_each_time_that_it_goes_down() -> None:
    keys, switched = HeardKeys(), list[str]()
    with open_takeover_key("f9", lambda: switched.append("over"), keys.listening):
        for name in ("f9", "f9", "f12"):  # a key that is held long goes down again and again
            keys.press(name)
        assert switched == ["over"]
        keys.release("f9")
        keys.press("f9")
    assert switched == ["over", "over"]
    assert not keys.is_listening
