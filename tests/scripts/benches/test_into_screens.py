"""Which presses for the world a soak counts as having reached a screen over it."""

import pytest

from scripts.benches.into_screens import ScreenPresses
from sim.client.client import VirtualClient


def pressed_after(opened_s: float, screen: str = "pause") -> tuple[int, int]:
    """Return what is counted if a key is pressed so many seconds after a screen opened, without looking."""
    client = VirtualClient(version="26.3")
    presses = ScreenPresses(client)
    controller = presses.controller()
    client.clock.sleep(0.5)
    if screen == "pause":
        client.game.open("pause")
    client.clock.sleep(opened_s)
    controller.confirm_screen("world")
    controller.tap("1")
    client.clock.sleep(0.2)
    return presses.into_screens, presses.too_late


def test_press_after_a_picture_of_the_screen_is_counted() -> None:
    assert pressed_after(0.3) == (1, 0)


def test_press_before_any_picture_of_the_screen_is_counted_separately() -> None:
    assert pressed_after(0.0) == (0, 1)


@pytest.mark.parametrize("after_s", [0.0, 0.3])
def test_a_press_in_the_world_is_not_counted(after_s: float) -> None:
    assert pressed_after(after_s, "world") == (0, 0)


def test_a_release_and_a_key_for_the_menu_do_not_count() -> None:
    client = VirtualClient(version="26.3")
    presses = ScreenPresses(client)
    controller = presses.controller()
    controller.confirm_screen("world")
    controller.press(client.clock.now() + 0.5, "w")
    client.clock.sleep(0.1)
    client.game.open("pause")
    client.clock.sleep(0.3)
    controller.release_all()
    controller.confirm_screen("menu")
    controller.tap("esc", on="menu")
    client.clock.sleep(0.2)
    assert (presses.into_screens, presses.too_late) == (0, 0)
    assert client.game.screen == "world"
