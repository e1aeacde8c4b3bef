"""Spoiled episodes: counted, borne for a while, and never where a person stopped the game."""

import pytest

from mc_nested.errors import NotConfirmedError, StoppedError
from mc_nested.live.spoiled import MOST_IN_A_ROW, PROGRESS, Spoiled

ERROR = NotConfirmedError("the agent looks away")


def test_spoiled_episodes_are_counted_with_what_was_said_last() -> None:
    spoiled = Spoiled()
    for steps in range(4):
        spoiled.count(NotConfirmedError(f"problem {steps}"), steps)
    assert spoiled.summary() == {"spoiled_episodes": 4, "last_problems": ["problem 1", "problem 2", "problem 3"]}


def test_too_many_in_a_row_are_an_error() -> None:
    spoiled = Spoiled()
    for _ in range(MOST_IN_A_ROW):
        spoiled.count(ERROR, 3)
    with pytest.raises(NotConfirmedError, match="looks away"):
        spoiled.count(ERROR, 3)


def test_those_with_progress_between_them_go_on() -> None:
    spoiled = Spoiled()
    for episode in range(10 * MOST_IN_A_ROW):
        spoiled.count(ERROR, episode * PROGRESS)


def test_a_person_who_stops_the_game_is_heeded_at_once() -> None:
    with pytest.raises(StoppedError):
        Spoiled().count(StoppedError("the panic key was pressed"), 0)
