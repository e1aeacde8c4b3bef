"""The corners of a screen, and the watchdog that releases overdue keys.

The watchdog: what is held too long goes up, even while the program does nothing.
"""

import time

import pytest

from mc_nested.live.input.input_controller import OVERDUE_S, InputController
from mc_nested.live.input.stops import corners_of, watched
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, devices_of


@pytest.mark.parametrize("corner", [(0, 0), (1919, 0), (0, 1079), (1919, 1079)])
def test_the_corners_are_the_first_and_last_points_of_each_side(corner: tuple[int, int]) -> None:
    assert corner in corners_of(1920, 1080)


@pytest.mark.parametrize("point", [(1, 0), (1920, 0), (0, 1080), (960, 540), (1918, 1079)])
def test_points_beside_or_beyond_the_corners_are_not_corners(point: tuple[int, int]) -> None:
    assert point not in corners_of(1920, 1080)


@pytest.mark.realtime
def test_the_watchdog_thread_releases_an_overdue_key() -> None:
    game = FakeGame(Profile())
    controller = InputController(devices_of(game), game.profile.input)
    controller.confirm_screen("world")
    with watched(controller):
        controller.press(game.clock.now() + 0.25, "w")
        game.clock.time += 0.25 + OVERDUE_S
        until = time.monotonic() + 2.0
        while game.down and time.monotonic() < until:
            time.sleep(0.01)
        assert game.down == set()


@pytest.mark.realtime
def test_the_watchdog_thread_leaves_a_key_down_until_it_is_overdue() -> None:
    game = FakeGame(Profile())
    controller = InputController(devices_of(game), game.profile.input)
    controller.confirm_screen("world")
    with watched(controller):
        controller.press(game.clock.now() + 0.25, "w")
        time.sleep(0.12)
        assert game.down == {"w"}
    controller.release_all()
