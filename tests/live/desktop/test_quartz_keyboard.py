"""Keys on macOS, with a made-up pynput: by virtual keycode, and modifiers by pynput's own names."""

from typing import Any

import pytest

from mc_nested.errors import DesktopError
from mc_nested.live.model.keys import PLACES
from tests.live.desktop.fake_devices import Controller, Key, install_pynput, reloaded


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Any:
    install_pynput(monkeypatch)
    return reloaded("mc_nested.live.desktop.quartz_keyboard", monkeypatch)


@pytest.mark.parametrize("name", ["a", "w", "f3", "enter"])
def test_a_key_is_sent_by_the_virtual_keycode_of_its_place(name: str, module: Any) -> None:
    controller = Controller()
    sender = module.QuartzKeySender(controller)
    sender.send(PLACES[name], is_down=True)
    sender.send(PLACES[name], is_down=False)
    (down, pressed), (up, released) = controller.sent
    assert (down, pressed.vk, pressed.char) == ("press", PLACES[name].mac, None)
    assert (up, released.vk) == ("release", PLACES[name].mac)


@pytest.mark.parametrize(
    ("name", "key"), [("left.shift", "shift_l"), ("right.control", "ctrl_r"), ("left.win", "cmd_l")]
)
def test_a_modifier_is_sent_by_pynputs_name(name: str, key: str, module: Any) -> None:
    controller = Controller()
    module.QuartzKeySender(controller).send(PLACES[name], is_down=True)
    assert controller.sent == [("press", Key[key])]


def test_a_typed_character_is_released_even_when_interrupted(module: Any) -> None:
    controller = Controller()
    sender = module.QuartzKeySender(controller)
    sender.type("~")
    controller.is_interrupted = True
    with pytest.raises(KeyboardInterrupt):
        sender.type("t")
    assert controller.sent == [("press", "~"), ("release", "~"), ("press", "t"), ("release", "t")]


def test_a_character_that_can_not_be_typed_is_an_error(module: Any) -> None:
    with pytest.raises(DesktopError, match="'木' can't be typed with this keyboard layout"):
        module.QuartzKeySender(Controller()).type("木")
