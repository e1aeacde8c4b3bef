import math

import numpy as np
import pytest

from sim.client.desktop.clock import Frames, VirtualClock
from sim.client.desktop.pointer import VirtualPointer
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls
from sim.client.game.edition import Edition
from sim.client.game.game import VirtualGame
from sim.client.game.realm import Player, Realm
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.game.world import VirtualWorld


class Desktop:
    """A mouse over a window of 855 x 481 pixels at GUI scale 2."""

    def __init__(self, screen: ScreenName = "world") -> None:
        self.clock = VirtualClock(0.0)
        self.window = VirtualWindow(self.clock, Frames(math.inf), np.random.default_rng(0), (855, 481), (0.01, 0.01))
        self.game = VirtualGame(Realm(Edition("1.20.1"), VirtualWorld(64, "dirt"), Player((0.5, 64.0, 0.5))))
        self.game.open(screen)
        controls = Controls(self.game, lambda: "", lambda _: None)
        self.pointer = VirtualPointer(self.clock, self.window, self.game, controls, lambda: 2)

    def view(self) -> tuple[float, float]:
        self.clock.sleep(0.02)
        return self.game.realm.player.yaw, self.game.realm.player.pitch


def test_the_game_holds_the_mouse_in_the_middle_while_its_world_is_in_front() -> None:
    desktop = Desktop()
    desktop.window.pointer = (1, 2)
    assert desktop.pointer.position() == (427, 240)
    desktop.window.is_in_front = False
    assert desktop.pointer.position() == (1, 2)
    desktop.window.is_in_front = True
    desktop.game.open("chat")
    assert desktop.pointer.position() == (1, 2)


def test_moving_the_held_mouse_turns_the_view_later() -> None:
    desktop = Desktop()
    desktop.pointer.move(427 + 10, 240 - 20)
    assert desktop.game.realm.player.yaw == 0
    assert desktop.view() == pytest.approx((1.5, -3.0))
    desktop.pointer.move(427 - 10, 240)
    assert desktop.view() == pytest.approx((0.0, -3.0))


def test_on_a_menu_the_mouse_moves_in_gui_pixels() -> None:
    desktop = Desktop("pause")
    desktop.pointer.move(101, 51)
    assert desktop.pointer.position() == (101, 51)
    assert desktop.game.pointer == (50, 25)
    assert desktop.view() == (0.0, 0.0)


def test_the_first_movement_after_a_menu_is_lost() -> None:
    desktop = Desktop("pause")
    desktop.pointer.move(101, 51)
    desktop.game.open("world")
    desktop.pointer.move(500, 240)
    assert desktop.view() == (0.0, 0.0)
    desktop.pointer.move(437, 240)
    assert desktop.view() == pytest.approx((1.5, 0.0))


def test_a_click_lands_on_the_button_under_the_mouse_when_it_is_pressed() -> None:
    desktop = Desktop("pause")
    back = menu(MenuState("pause"), desktop.game.edition, 428, 241).buttons[0]
    desktop.pointer.move(2 * back.left, 2 * back.top)
    desktop.pointer.press("left")
    assert desktop.window.down == {"left button"}
    desktop.pointer.move(0, 0)
    assert desktop.game.screen == "pause"
    desktop.clock.sleep(0.02)
    assert str(desktop.game.screen) == "world"
    desktop.pointer.release("left")
    assert desktop.window.down == set()


def test_a_click_at_the_right_edge_of_an_odd_sized_window_hits_the_button() -> None:
    desktop = Desktop("title")
    quit_game = menu(MenuState("title"), desktop.game.edition, 428, 241).buttons[0]
    desktop.pointer.move(2 * (quit_game.left + quit_game.width) - 1, 2 * (quit_game.top + 1))
    desktop.pointer.press("left")
    desktop.clock.sleep(0.02)
    assert desktop.game.screen == "worlds"


def test_mouse_buttons_are_pressed_and_released_in_the_world() -> None:
    desktop = Desktop()
    desktop.pointer.press("right")
    desktop.clock.sleep(0.02)
    assert desktop.game.keys.is_held("use")
    desktop.pointer.release("right")
    desktop.clock.sleep(0.02)
    assert not desktop.game.keys.is_held("use")


def test_two_clicks_a_tenth_of_a_second_apart_are_a_double_click() -> None:
    desktop = Desktop("worlds")
    row = menu(MenuState("worlds"), desktop.game.edition, 428, 241).buttons[1]
    desktop.pointer.move(2 * (row.left + 5), 2 * (row.top + 5))
    for _ in range(2):
        desktop.pointer.press("left")
        desktop.pointer.release("left")
        desktop.clock.sleep(0.1)
    assert desktop.game.screen == "loading"
