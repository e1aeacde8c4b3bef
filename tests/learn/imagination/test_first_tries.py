"""First tries: which are left to other games, and that a copy is independent."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.imagination.first_tries import CLAIMED, FirstTries

ACTIONS = 8


def tries_of(untried: set[int]) -> FirstTries:
    shown = np.array([action in untried for action in range(ACTIONS)])
    return FirstTries(True, False, False, shown, np.zeros(ACTIONS, np.bool_), np.zeros(ACTIONS, np.int64))


def first_actions(tries: FirstTries, steps: int) -> list[int]:
    """Return the actions of that many steps, each of which moves; the policy's own action is 0."""
    done = []
    for _ in range(steps):
        action = tries.act(0, [])
        tries.observe(action, True, [])
        done.append(action)
    return done


def test_each_game_tries_different_actions_first_and_then_the_others() -> None:
    assert CLAIMED == 2
    every = [first_actions(tries_of(set(range(ACTIONS))).beside(games), ACTIONS) for games in range(4)]
    assert [actions[:CLAIMED] for actions in every] == [[0, 1], [2, 3], [4, 5], [6, 7]]
    assert all(set(actions) == set(range(ACTIONS)) for actions in every)


@given(st.sets(st.integers(0, ACTIONS - 1)), st.integers(0, 9))
def test_leaving_tries_to_other_games_changes_only_untried_actions_of_a_copy(untried: set[int], games: int) -> None:
    tries = tries_of(untried)
    beside = tries.beside(games)
    assert tries.tries.tolist() == [0] * ACTIONS
    assert beside.untried.tolist() == tries.untried.tolist()
    assert {int(action) for action in np.flatnonzero(beside.tries)} <= untried
    assert beside.tries.sum() == games * min(CLAIMED, len(untried))
    first_actions(beside, 3)
    assert tries.untried.tolist() == [action in untried for action in range(ACTIONS)]


def test_first_tries_skip_actions_already_done_in_the_same_cell() -> None:
    tries = tries_of({3, 4})
    assert tries.act(0, []) == 3
    assert tries.act(0, [3]) == 4
    assert tries.act(0, [3, 4]) == 0
