"""The panic switch: on a made-up keyboard and mouse, and on real ones under Xvfb."""

import pytest

from mc_nested.errors import ProfileError
from mc_nested.live.desktop.panic import CLOSE_S, open_panic_switch
from mc_nested.live.input.panic import CORNER_REASON, KEY_REASON
from tests.live.desktop.fake_devices import Key, KeyCode, Listener, install_mouse, install_pynput
from tests.live.desktop.probed import probed

Listeners = tuple[list[Listener], list[Listener]]


@pytest.fixture
def listeners(monkeypatch: pytest.MonkeyPatch) -> Listeners:
    """Those of the keyboard and of the mouse, over a screen of 1024 x 768."""
    install_mouse(monkeypatch)
    return install_pynput(monkeypatch)


@pytest.mark.parametrize(
    ("name", "key"), [("f12", Key["f12"]), ("left.shift", Key["shift_l"]), ("p", KeyCode(char="p"))]
)
def test_the_panic_key_stops_as_soon_as_it_goes_down(name: str, key: object, listeners: Listeners) -> None:
    stopped: list[str] = []
    with open_panic_switch(name, stopped.append):
        listeners[0][0].heard["on_press"](key)
        assert stopped == [KEY_REASON]


def test_no_other_key_stops(listeners: Listeners) -> None:
    stopped: list[str] = []
    with open_panic_switch("f12", stopped.append):
        for key in (Key["f11"], KeyCode(char="w"), KeyCode(vk=5), None):
            listeners[0][0].heard["on_press"](key)
    with open_panic_switch("p", stopped.append):
        for key in (Key["f12"], KeyCode(char="q"), None):
            listeners[0][1].heard["on_press"](key)
    assert stopped == []


def test_the_mouse_in_any_corner_stops_and_nowhere_else(listeners: Listeners) -> None:
    stopped: list[str] = []
    with open_panic_switch("f12", stopped.append):
        move = listeners[1][0].heard["on_move"]
        for at in ((1, 0), (0, 1), (1024, 768), (1022, 767), (512, 0)):
            move(*at)
        assert stopped == []
        for at in ((0, 0), (1023, 0), (0, 767), (1023, 767)):
            move(*at)
    assert stopped == [CORNER_REASON] * 4


def test_it_listens_for_as_long_as_the_context_lasts_and_waits_for_its_listeners(listeners: Listeners) -> None:
    with open_panic_switch("f12", lambda _: None):
        assert all(listener.is_alive() for (listener,) in listeners)
    for (listener,) in listeners:
        assert not listener.is_alive()
        assert listener.joined == [CLOSE_S]


def test_a_name_that_no_key_has_is_an_error_before_anything_listens(listeners: Listeners) -> None:
    with pytest.raises(ProfileError, match="no key is named 'shift'"), open_panic_switch("shift", lambda _: None):
        pass
    assert listeners == ([], [])


@pytest.mark.standin
def test_a_real_key_and_a_real_mouse_stop_within_a_tenth_of_a_second(x_server: dict[str, str]) -> None:
    report = probed(x_server, "panic")
    assert [reason for reason, _ in report["stopped by"]] == [KEY_REASON, CORNER_REASON, CORNER_REASON]
    assert max(seconds for _, seconds in report["stopped by"]) <= 0.1
