"""The real keyboard: with a made-up pynput, and in a real window under Xvfb."""

import importlib
import os
import subprocess
import sys
from typing import Any

import pytest

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live import desktop
from tests.live.desktop.fake_devices import Controller, Key, install_pynput
from tests.live.desktop.probed import probed

MODULE = "mc_nested.live.desktop.keyboard"

on_linux = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="how keys are sent to an X server")


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The module over a made-up pynput; whatever of it was loaded comes back afterwards."""
    install_pynput(monkeypatch)
    monkeypatch.setattr(desktop, "keyboard", None, raising=False)
    monkeypatch.setitem(sys.modules, MODULE, sys)
    del sys.modules[MODULE]
    return importlib.import_module(MODULE)


@pytest.fixture
def keyboard(module: Any) -> Any:
    return module.DesktopKeyboard()


def sent(keyboard: Any) -> list[tuple[str, Any]]:
    controller: Controller = keyboard._controller
    return controller.sent


@pytest.mark.parametrize(("name", "key"), [("f3", "f3"), ("left.shift", "shift_l"), ("escape", "esc")])
def test_a_word_is_pynputs_key_of_that_meaning(name: str, key: str, module: Any) -> None:
    assert module.pynput_key(name) is Key[key]


@on_linux
@pytest.mark.parametrize(("name", "keysym"), [("w", 0x77), ("W", 0x77), ("/", 0x2F)])
def test_a_character_is_pressed_as_its_keysym(name: str, keysym: int, module: Any) -> None:
    key = module.pynput_key(name)
    assert (key.vk, key.char) == (keysym, None)


def test_a_name_that_no_key_has_is_an_error(module: Any, keyboard: Any) -> None:
    for act in (module.pynput_key, keyboard.press, keyboard.release):
        with pytest.raises(ProfileError, match="no key is named 'shift'"):
            act("shift")
    assert sent(keyboard) == []


@on_linux
def test_keys_are_pressed_released_and_typed_in_order(keyboard: Any) -> None:
    keyboard.press("f3")
    keyboard.press("w")
    keyboard.release("w")
    keyboard.type("/tp")
    (kind, key), (_, pressed), (other, released), typed = sent(keyboard)
    assert (kind, key, pressed.vk) == ("press", Key["f3"], ord("w"))
    assert (other, released.vk, typed) == ("release", ord("w"), ("type", "/tp"))


@on_linux
def test_a_key_that_the_layout_lacks_is_an_error_before_anything_is_sent(keyboard: Any) -> None:
    for act in (keyboard.press, keyboard.release):
        with pytest.raises(DesktopError, match="layout has no key 'é': switch to a Latin one"):
            act("é")
    assert sent(keyboard) == []


def test_a_text_that_can_not_be_typed_is_an_error(keyboard: Any) -> None:
    with pytest.raises(DesktopError, match="'木' can't be typed with this keyboard layout"):
        keyboard.type("木")


@on_linux
def test_without_a_display_a_press_is_an_error_and_a_release_is_none(keyboard: Any) -> None:
    keyboard._controller.has_display = False
    for act in (keyboard.press, keyboard.type):
        with pytest.raises(DesktopError, match="display has closed"):
            act("w")
    keyboard.release("w")


def test_every_word_for_a_key_is_known_to_pynput() -> None:
    code = (
        "from pynput.keyboard import Key\n"
        "from mc_nested.live.model.key_names import WORDS\n"
        "print(set(WORDS.values()) - set(Key.__members__))"
    )
    environment = {**os.environ, "PYNPUT_BACKEND": "dummy"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert done.stdout == "set()\n", done.stderr


@pytest.mark.standin
def test_keys_reach_a_real_window_as_a_keyboards_own(x_server: dict[str, str]) -> None:
    report = probed(x_server, "keyboard")
    keys = [(event[0], event[2]) for event in report["keys"]]
    assert keys == [("press", False), ("release", False)] * 4, "as a keyboard's own, not as synthetic events"
    assert [event[1] for event in report["keys"] if event[0] == "press"] == [ord("w"), 0xFFC0, 0xFFE1, ord("/")]
    assert "no key 'é'" in report["no such key"]
    assert report["typed"] == "/Tp @s"
