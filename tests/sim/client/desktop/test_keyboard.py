"""The virtual keyboard: keys by their places, to 1.12 by what the layout makes there, and text by its characters."""

import math

import numpy as np
import pytest

from mc_nested.errors import ProfileError
from mc_nested.live.desktop.keyboard import DesktopKeyboard
from mc_nested.live.model.keys import PLACES
from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.keyboard import LAYOUTS, VirtualKeySender
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.world import VirtualWorld


class Typed:
    """A keyboard, the window that it is for, and the game in it."""

    def __init__(self, layout: str = "us", *, is_lwjgl_2: bool = False) -> None:
        self.clock = VirtualClock(0.0)
        self.window = VirtualWindow(self.clock, Frames(math.inf), np.random.default_rng(0), (80, 60), (0.01, 0.01))
        self.game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
        controls = Controls(self.game, lambda: "", lambda _: None)
        self.sender = VirtualKeySender(self.window, controls, layout, is_lwjgl_2=is_lwjgl_2)
        self.keyboard = DesktopKeyboard(self.sender)

    def held(self) -> set[str]:
        """Return the keys that the game takes for down."""
        self.clock.sleep(0.01)
        return self.game.keys.physical


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


def test_typed_text_reaches_the_game_as_its_characters() -> None:
    typed = Typed()
    typed.game.open("chat")
    typed.keyboard.type("/Tp ~木")
    assert typed.window.down == set()
    typed.clock.sleep(0.01)
    assert typed.game.chat.typed == "/Tp ~木"


def test_keys_type_their_us_characters_and_keys_named_by_a_word_type_nothing() -> None:
    typed = Typed()
    typed.game.open("chat")
    for key in ("A", "space", "/", "f3", "left.shift"):
        typed.keyboard.press(key)
        typed.keyboard.release(key)
    typed.clock.sleep(0.01)
    assert typed.game.chat.typed == "a /"


def test_text_typed_in_the_world_presses_its_keys() -> None:
    typed = Typed()
    typed.keyboard.type("E")
    typed.clock.sleep(0.01)
    typed.game.tick()
    assert typed.game.screen == "inventory"


def test_a_key_is_pressed_by_a_synonym_and_an_unknown_name_is_refused() -> None:
    typed = Typed()
    typed.keyboard.press("escape")
    typed.clock.sleep(0.01)
    assert typed.game.screen == "pause"
    for act in (typed.keyboard.press, typed.keyboard.release):
        with pytest.raises(ProfileError, match="no key is named"):
            act("shift")


@pytest.mark.parametrize(
    ("layout", "taken"),
    [
        ("us", {"w": "w", "a": "a", "1": "1", "/": "/"}),
        ("fr", {"w": "z", "a": "q", "4": "'", ",": ";"}),
        ("de", {"w": "w", "y": "z", "/": "-"}),
        ("dvorak", {"w": ",", "d": "e", "/": "z"}),
        ("il", {"w": "'", "q": "/"}),
    ],
)
def test_up_to_1_12_a_key_is_taken_by_what_the_layout_makes_at_its_place(layout: str, taken: dict[str, str]) -> None:
    # As a window of LWJGL 2.9.3 took them (tests/live/desktop/test_lwjgl2_window.py).
    for place, key in taken.items():
        typed = Typed(layout, is_lwjgl_2=True)
        typed.sender.send(PLACES[place], is_down=True)
        assert typed.held() == {key}
        typed.sender.send(PLACES[place], is_down=False)
        assert typed.held() == set()


def test_up_to_1_12_a_key_whose_symbol_lwjgl_2_lacks_does_nothing() -> None:
    typed = Typed("ru", is_lwjgl_2=True)
    typed.sender.send(PLACES["w"], is_down=True)
    assert typed.held() == set()


def test_from_1_13_on_a_key_is_taken_by_its_place_under_every_layout() -> None:
    for layout in LAYOUTS:
        typed = Typed(layout)
        typed.keyboard.press("w")
        assert typed.held() == {"w"}


def test_up_to_1_12_a_digit_pressed_with_shift_stays_down_if_released_without_it() -> None:
    typed = Typed("us", is_lwjgl_2=True)
    for place in ("left.shift", "2"):
        typed.sender.send(PLACES[place], is_down=True)
    assert typed.held() == {"left.shift", "@"}
    for place in ("left.shift", "2"):
        typed.sender.send(PLACES[place], is_down=False)
    assert typed.held() == {"@"}, "it went up as 2"


def test_keys_type_the_characters_of_the_layout() -> None:
    typed = Typed("fr")
    typed.game.open("chat")
    for place in ("w", "q", "2"):
        typed.keyboard.press(place)
        typed.keyboard.release(place)
    typed.clock.sleep(0.01)
    assert typed.game.chat.typed == "za·"
