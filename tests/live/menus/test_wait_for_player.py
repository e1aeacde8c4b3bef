"""Waiting for a person: what counts as standing still, and the error when time runs out."""

import dataclasses
from collections.abc import Callable

import pytest

from mc_nested.errors import NotInFrontError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.wait_for_player import PATIENCE_S, wait_for_front, wait_until_standing_still
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.timing import PERSON_LOOK_S
from mc_nested.live.profile.tables import Profile
from tests.live.fake_game import FakeGame, FakeScreen, devices_of

HERE = Reading((0.5, 64.0, 0.5), 0.0, 30.0)
THERE = Reading((0.7, 64.0, 0.5), 0.0, 30.0)


class SkippingClock:
    """A clock on which every wait is over at once."""

    def __init__(self) -> None:
        self._now = 0.0

    def now(self) -> float:
        return self._now

    def sleep_until(self, at: float) -> None:
        self._now = max(self._now, at)


class Window:
    """A window that comes to the front after some looks."""

    def __init__(self, looks_until_front: int) -> None:
        self._looks = looks_until_front

    def size(self) -> tuple[int, int]:
        raise AssertionError

    def title(self) -> str:
        raise AssertionError

    def is_in_front(self) -> bool:
        self._looks -= 1
        return self._looks < 0

    def grab(self, region: Region | None = None) -> Frame:
        raise AssertionError(region)


def standing(
    readings: list[Reading], looks_until_front: int = 0, say: Callable[[str], None] = lambda _: None
) -> Reading:
    """Return where the player is found to stand; the last of these readings is repeated."""
    game = FakeGame(Profile())
    later = iter(readings)
    devices = dataclasses.replace(devices_of(game), display=Window(looks_until_front), clock=SkippingClock())
    controller = InputController(devices, game.profile.input)
    return wait_until_standing_still(
        GameConnection(devices, controller, FakeScreen(game, lambda: next(later, readings[-1]))), say
    )


def test_the_player_stands_still_once_two_readings_in_a_row_are_equal() -> None:
    assert standing([Reading(problem="off"), THERE, HERE], looks_until_front=3) == HERE


def test_a_game_that_stays_behind_another_window_is_an_error() -> None:
    with pytest.raises(NotInFrontError, match="not by a click"):
        standing([HERE], looks_until_front=10**6)


def test_a_debug_screen_that_stays_off_is_an_error_with_the_readers_reason() -> None:
    with pytest.raises(UnreadableError, match=r"can't be read \(no XYZ line"):
        standing([Reading(problem="no XYZ line: press F3")])


def test_a_lasting_problem_of_the_debug_screen_is_said_once_and_a_short_one_never() -> None:
    said: list[str] = []
    off = [Reading(problem="no XYZ line: press F3")]
    assert standing([*off * 4, HERE], say=said.append) == HERE
    assert said == []
    assert standing([*off * 100, HERE], say=said.append) == HERE
    assert said == ["Waiting up to 60 s for the debug screen: no XYZ line: press F3"]


def test_a_player_who_never_stands_still_is_an_error() -> None:
    with pytest.raises(UnreadableError, match="keeps moving"):
        standing([HERE, THERE] * int(PATIENCE_S * 10))


def test_two_equal_problems_do_not_count_as_standing_still() -> None:
    assert standing([Reading(problem="off"), Reading(problem="off"), HERE]) == HERE


def test_a_reading_from_before_another_window_came_to_the_front_does_not_count() -> None:
    class Blinking(Window):
        """Another window is in front at every second look."""

        def is_in_front(self) -> bool:
            super().is_in_front()
            return self._looks % 2 == 0

    game = FakeGame(Profile())
    devices = dataclasses.replace(devices_of(game), display=Blinking(0), clock=SkippingClock())
    controller = InputController(devices, game.profile.input)
    connection = GameConnection(devices, controller, FakeScreen(game, lambda: HERE))
    with pytest.raises(UnreadableError, match="keeps moving"):
        wait_until_standing_still(connection)


def test_the_front_is_waited_for_a_minute_at_most() -> None:
    clock = SkippingClock()
    devices = devices_of(FakeGame(Profile()))
    wait_for_front(dataclasses.replace(devices, display=Window(3), clock=clock))
    assert clock.now() == 3 * PERSON_LOOK_S
    with pytest.raises(NotInFrontError, match="not by a click"):
        wait_for_front(dataclasses.replace(devices, display=Window(10**6), clock=clock))
    assert clock.now() == 3 * PERSON_LOOK_S + PATIENCE_S
