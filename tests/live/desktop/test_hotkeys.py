"""Hotkeys: what is heard of a made-up keyboard, and of a real one under Xvfb."""

import pytest

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.desktop.hotkeys import open_hotkeys
from tests.live.desktop.fake_devices import Key, KeyCode, Listener, install_pynput
from tests.live.desktop.probed import probed


@pytest.fixture
def listeners(monkeypatch: pytest.MonkeyPatch) -> list[Listener]:
    return install_pynput(monkeypatch)[0]


def test_keys_are_heard_in_order_each_once_however_long_it_is_held(listeners: list[Listener]) -> None:
    with open_hotkeys(("f9", "k")) as next_key:
        press, release = (listeners[0].heard[name] for name in ("on_press", "on_release"))
        for _ in range(3):
            press(Key["f9"])
        release(Key["f9"])
        press(KeyCode(char="k"))
        press(Key["f9"])
        assert [next_key() for _ in range(3)] == ["f9", "k", "f9"]


def test_other_keys_are_not_heard(listeners: list[Listener]) -> None:
    with open_hotkeys(("f9", "k")) as next_key:
        for key in (Key["f8"], KeyCode(char="w"), KeyCode(vk=107), None, KeyCode(char="k")):
            listeners[0].heard["on_press"](key)
        assert next_key() == "k"
        listeners[0].is_running = False
        with pytest.raises(DesktopError):
            next_key()


def test_a_desktop_that_lets_no_program_listen_is_an_error(
    listeners: list[Listener], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Listener, "is_silent", True)
    with open_hotkeys(("f9",)) as next_key, pytest.raises(DesktopError, match="lets no program listen"):
        next_key()
    assert len(listeners) == 1


def test_it_listens_for_as_long_as_the_context_lasts(listeners: list[Listener]) -> None:
    with open_hotkeys(("f9",)):
        assert listeners[0].is_alive()
    assert not listeners[0].is_alive()


def test_a_name_that_no_key_has_is_an_error_before_anything_listens(listeners: list[Listener]) -> None:
    with pytest.raises(ProfileError, match="no key is named 'shift'"), open_hotkeys(("f9", "shift")):
        pass
    assert listeners == []


@pytest.mark.standin
def test_a_real_key_that_repeats_is_heard_once_and_others_not_at_all(x_server: dict[str, str]) -> None:
    assert probed(x_server, "hotkeys")["hotkeys"] == ["f9", "k", "f9"]
