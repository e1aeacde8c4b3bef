"""Waiting for a person: what is taken for their stand, and what they are told when time runs out."""

import pytest

from mc_nested.errors import NotInFrontError, UnreadableError
from mc_nested.live.at_rest import PATIENCE_S, read_at_rest
from mc_nested.live.devices import Frame, Region
from mc_nested.live.reading import Reading

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


def at_rest(readings: list[Reading], looks_until_front: int = 0) -> Reading:
    """What is taken for the player's stand from readings of which the last one stays."""
    later = iter(readings)
    return read_at_rest(Window(looks_until_front), SkippingClock(), lambda: next(later, readings[-1]))


def test_a_stand_is_believed_once_it_was_seen_twice_in_a_row() -> None:
    assert at_rest([Reading(problem="off"), THERE, HERE], looks_until_front=3) == HERE


def test_a_game_that_stays_behind_another_window_is_told() -> None:
    with pytest.raises(NotInFrontError, match="click on it"):
        at_rest([HERE], looks_until_front=10**6)


def test_a_debug_screen_that_stays_off_is_told_with_the_readers_reason() -> None:
    with pytest.raises(UnreadableError, match=r"can't be read \(no XYZ line"):
        at_rest([Reading(problem="no XYZ line: press F3")])


def test_a_player_who_never_stands_still_is_told() -> None:
    with pytest.raises(UnreadableError, match="keeps moving"):
        at_rest([HERE, THERE] * int(PATIENCE_S * 10))
