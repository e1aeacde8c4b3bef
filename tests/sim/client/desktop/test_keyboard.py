"""The virtual keyboard: keys by their places, text by its characters."""

import math

import numpy as np
import pytest

from mc_nested.errors import ProfileError
from sim.client.desktop.clock import VirtualClock
from sim.client.desktop.frames import Frames
from sim.client.desktop.keyboard import VirtualKeyboard
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld


class Typed:
    """A keyboard, the window that it is for, and the game in it."""

    def __init__(self) -> None:
        self.clock = VirtualClock(0.0)
        self.window = VirtualWindow(self.clock, Frames(math.inf), np.random.default_rng(0), (80, 60), (0.01, 0.01))
        self.game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
        self.keyboard = VirtualKeyboard(self.window, Controls(self.game, lambda: "", lambda _: None))


def test_keys_reach_the_game_after_the_windows_latency() -> None:
    typed = Typed()
    typed.keyboard.press("w")
    assert typed.window.down == {"w"}
    assert not typed.game.keys.is_held("forward")
    typed.clock.sleep(0.01)
    assert typed.game.keys.is_held("forward")
    typed.keyboard.release("w")
    assert typed.window.down == set()
    typed.clock.sleep(0.01)
    assert not typed.game.keys.is_held("forward")


def test_text_comes_as_its_characters() -> None:
    typed = Typed()
    typed.game.open("chat")
    typed.keyboard.type("/Tp ~木")
    assert typed.window.down == set()
    typed.clock.sleep(0.01)
    assert typed.game.chat.typed == "/Tp ~木"


def test_a_key_types_what_a_us_keyboard_has_there_and_one_with_a_word_for_a_name_types_nothing() -> None:
    typed = Typed()
    typed.game.open("chat")
    for key in ("A", "space", "/", "f3", "left.shift"):
        typed.keyboard.press(key)
        typed.keyboard.release(key)
    typed.clock.sleep(0.01)
    assert typed.game.chat.typed == "a /"


def test_text_in_the_world_presses_the_keys_that_have_it() -> None:
    typed = Typed()
    typed.keyboard.type("E")
    typed.clock.sleep(0.01)
    typed.game.tick()
    assert typed.game.screen == "inventory"


def test_a_key_has_any_of_its_names_and_an_unknown_name_is_an_error() -> None:
    typed = Typed()
    typed.keyboard.press("escape")
    typed.clock.sleep(0.01)
    assert typed.game.screen == "pause"
    for act in (typed.keyboard.press, typed.keyboard.release):
        with pytest.raises(ProfileError, match="no key is named"):
            act("shift")
