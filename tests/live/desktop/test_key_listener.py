"""Keys heard by their places: from pynput's hook on Windows, from its keycodes on macOS, and on a real X server.

Hotkeys: what is heard of a made-up keyboard, and of a real one under Xvfb.
"""

import sys
import threading
from types import SimpleNamespace

import pytest

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.desktop.key_listener import CLOSE_S, listening, listening_through_pynput, open_hotkeys
from tests.live.desktop.fake_devices import KeyCode, Listener, install_pynput
from tests.live.desktop.real_windows.heard_keys import HeardKeys
from tests.live.desktop.real_windows.probed import probed

KEY_DOWN, KEY_UP, SYSTEM_KEY_DOWN, OTHER = 0x0100, 0x0101, 0x0104, 0x0051
PACKET = 0xE7


@pytest.fixture
def listeners(monkeypatch: pytest.MonkeyPatch) -> list[Listener]:
    return install_pynput(monkeypatch)[0]


def hook_event(scan: int, *, is_extended: bool = False, virtual: int = 0x57) -> SimpleNamespace:
    """KBDLLHOOKSTRUCT, as far as it is read."""
    return SimpleNamespace(scanCode=scan, flags=0x10 | int(is_extended), vkCode=virtual)


def test_windows_keys_have_the_names_of_their_scancodes(listeners: list[Listener]) -> None:
    heard: list[tuple[str, bool]] = []
    with listening_through_pynput(lambda *key: heard.append(key)):
        on_hook = listeners[0].heard["win32_event_filter"]
        on_hook(KEY_DOWN, hook_event(0x11))
        on_hook(KEY_UP, hook_event(0x11))
        on_hook(KEY_DOWN, hook_event(0x1D, is_extended=True))
        on_hook(SYSTEM_KEY_DOWN, hook_event(0x44))
    assert heard == [("w", True), ("w", False), ("right.control", True), ("f10", True)]


def test_the_listener_ignores_windows_events_that_are_not_of_known_keys(listeners: list[Listener]) -> None:
    heard: list[tuple[str, bool]] = []
    with listening_through_pynput(lambda *key: heard.append(key)):
        on_hook = listeners[0].heard["win32_event_filter"]
        on_hook(KEY_DOWN, hook_event(0x11, virtual=PACKET))
        on_hook(OTHER, hook_event(0x11))
        on_hook(KEY_DOWN, hook_event(0x6F))
    assert heard == []


def test_pynput_does_not_ask_windows_layout_for_any_key(listeners: list[Listener]) -> None:
    with listening_through_pynput(lambda *_: None):
        for message in (KEY_DOWN, KEY_UP, OTHER):
            assert listeners[0].heard["win32_event_filter"](message, hook_event(0x11)) is False


def test_macos_keys_have_the_names_of_their_keycodes_whatever_they_type(listeners: list[Listener]) -> None:
    heard: list[tuple[str, bool]] = []
    with listening_through_pynput(lambda *key: heard.append(key)):
        press, release = (listeners[0].heard[name] for name in ("on_press", "on_release"))
        press(KeyCode(vk=0x0D, char="z"))
        release(KeyCode(vk=0x0D, char="z"))
        press(SimpleNamespace(value=KeyCode(vk=0x6F)))
        for key in (None, KeyCode(char="w"), KeyCode(vk=0x999)):
            press(key)
            release(key)
    assert heard == [("w", True), ("w", False), ("f12", True)]


def test_a_slow_callback_does_not_hold_up_the_hook(listeners: list[Listener]) -> None:
    may_go_on, heard = threading.Event(), list[str]()

    def on_key(name: str, _: bool) -> None:
        assert may_go_on.wait(10)
        heard.append(name)

    with listening_through_pynput(on_key):
        on_hook = listeners[0].heard["win32_event_filter"]
        on_hook(KEY_DOWN, hook_event(0x11))
        on_hook(KEY_DOWN, hook_event(0x1E))
        assert heard == []
        may_go_on.set()
    assert heard == ["w", "a"]


def test_leaving_the_context_stops_the_listener_and_joins_its_thread(listeners: list[Listener]) -> None:
    with listening_through_pynput(lambda *_: None) as is_listening:
        assert is_listening()
    assert not is_listening()
    assert listeners[0].joined == [CLOSE_S]


if sys.platform.startswith("linux"):

    @pytest.mark.window
    def test_an_x_servers_keys_are_heard(x_screen: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("DISPLAY", x_screen["DISPLAY"])
        with listening(lambda *_: None) as is_listening:
            assert is_listening()
        assert not is_listening()


def test_hotkeys_are_heard_in_order_and_a_held_key_only_once() -> None:
    keys = HeardKeys()
    with open_hotkeys(("f9", "k"), keys.listening) as next_key:
        for _ in range(3):
            keys.press("f9")
        keys.release("f9")
        keys.press("k")
        keys.press("f9")
        assert [next_key() for _ in range(3)] == ["f9", "k", "f9"]


def test_a_hotkey_may_have_any_name_of_its_key_and_is_returned_under_that_name() -> None:
    keys = HeardKeys()
    with open_hotkeys(("escape", "K"), keys.listening) as next_key:
        keys.press("esc")
        keys.press("k")
        assert [next_key() for _ in range(2)] == ["escape", "K"]


def test_keys_that_are_not_hotkeys_are_ignored() -> None:
    keys = HeardKeys()
    with open_hotkeys(("f9", "k"), keys.listening) as next_key:
        for name in ("f8", "w", "k"):
            keys.press(name)
        assert next_key() == "k"
        keys.is_listening = False
        with pytest.raises(DesktopError):
            next_key()


def test_a_desktop_that_lets_no_program_listen_is_an_error() -> None:
    keys = HeardKeys(is_silent=True)
    with (
        open_hotkeys(("f9",), keys.listening) as next_key,
        pytest.raises(DesktopError, match="lets no program listen"),
    ):
        next_key()


def test_hotkeys_are_heard_for_as_long_as_the_context_lasts() -> None:
    keys = HeardKeys()
    with open_hotkeys(("f9",), keys.listening):
        assert keys.is_listening
    assert not keys.is_listening


def test_an_unknown_hotkey_is_refused_before_the_listener_starts() -> None:
    keys = HeardKeys()
    with (
        pytest.raises(ProfileError, match="no key is named 'shift'"),
        open_hotkeys(("f9", "shift"), keys.listening),
    ):
        pass
    assert not keys.is_listening


@pytest.mark.standin
def test_a_repeating_real_hotkey_is_heard_once_and_other_keys_are_ignored(x_server: dict[str, str]) -> None:
    assert probed(x_server, "hotkeys")["hotkeys"] == ["f9", "k", "f9"]
