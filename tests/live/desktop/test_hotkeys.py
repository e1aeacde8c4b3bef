"""Hotkeys: what is heard of a made-up keyboard, and of a real one under Xvfb."""

import pytest

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.desktop.hotkeys import open_hotkeys
from tests.live.desktop.heard_keys import HeardKeys
from tests.live.desktop.probed import probed


def test_keys_are_heard_in_order_each_once_however_long_it_is_held() -> None:
    keys = HeardKeys()
    with open_hotkeys(("f9", "k"), keys.listening) as next_key:
        for _ in range(3):
            keys.press("f9")
        keys.release("f9")
        keys.press("k")
        keys.press("f9")
        assert [next_key() for _ in range(3)] == ["f9", "k", "f9"]


def test_a_key_is_heard_by_any_of_its_names_and_called_as_it_was_asked_for() -> None:
    keys = HeardKeys()
    with open_hotkeys(("escape", "K"), keys.listening) as next_key:
        keys.press("esc")
        keys.press("k")
        assert [next_key() for _ in range(2)] == ["escape", "K"]


def test_other_keys_are_not_heard() -> None:
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


def test_it_listens_for_as_long_as_the_context_lasts() -> None:
    keys = HeardKeys()
    with open_hotkeys(("f9",), keys.listening):
        assert keys.is_listening
    assert not keys.is_listening


def test_a_name_that_no_key_has_is_an_error_before_anything_listens() -> None:
    keys = HeardKeys()
    with (
        pytest.raises(ProfileError, match="no key is named 'shift'"),
        open_hotkeys(("f9", "shift"), keys.listening),
    ):
        pass
    assert not keys.is_listening


@pytest.mark.standin
def test_a_real_key_that_repeats_is_heard_once_and_others_not_at_all(x_server: dict[str, str]) -> None:
    assert probed(x_server, "hotkeys")["hotkeys"] == ["f9", "k", "f9"]
