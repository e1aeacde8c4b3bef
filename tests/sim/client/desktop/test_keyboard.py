import math

import numpy as np

from sim.client.desktop.clock import VirtualClock
from sim.client.desktop.frames import Frames
from sim.client.desktop.keyboard import VirtualKeyboard
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld


def test_keys_reach_the_game_after_the_windows_latency() -> None:
    clock = VirtualClock(0.0)
    window = VirtualWindow(clock, Frames(math.inf), np.random.default_rng(0), (80, 60), (0.01, 0.01))
    game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
    keyboard = VirtualKeyboard(window, Controls(game, lambda: "", lambda _: None))
    keyboard.press("w")
    assert window.down == {"w"}
    assert not game.keys.is_held("forward")
    clock.sleep(0.01)
    assert game.keys.is_held("forward")
    keyboard.release("w")
    assert window.down == set()
    clock.sleep(0.01)
    assert not game.keys.is_held("forward")
    game.open("chat")
    keyboard.type("/tp")
    assert window.down == set()
    clock.sleep(0.01)
    assert game.chat.typed == "/tp"


def test_a_key_makes_the_character_of_a_keyboard_of_the_united_states_but_none_with_control() -> None:
    clock = VirtualClock(0.0)
    window = VirtualWindow(clock, Frames(math.inf), np.random.default_rng(0), (80, 60), (0.01, 0.01))
    game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
    keyboard = VirtualKeyboard(window, Controls(game, lambda: "pasted", lambda _: None))
    game.open("chat")
    for key in ("h", "space", "f5", "left.shift"):
        keyboard.press(key)
        keyboard.release(key)
    clock.sleep(0.02)
    assert game.chat.typed == "h "
    for key in ("left.control", "x"):
        keyboard.press(key)
    clock.sleep(0.02)
    assert game.chat.typed == "h "
