"""What an episode is expected to do is what it does, where the learnt game is the real one."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.learn.imagination.arena_step import imagined_arena
from mc_nested.learn.imagination.beliefs import believe
from mc_nested.learn.imagination.expected_episode import State, expected_landings
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.learnt_rules import LearntRules
from tests.learn.imagination.made_games import BENT, TRUE_MOVES, TRUE_PLACES

TRUE_RULES = LearntRules(np.array(TRUE_MOVES), np.ones(8, np.bool_), np.array(TRUE_PLACES), (0, 1))
ARENA = imagined_arena(TRUE_RULES, believe(np.zeros((0, 9), np.int64), (0, 1), BENT.size, BENT.blocks))


def tries_of(untried: int | None = None) -> FirstTries:
    shown = np.arange(8) == untried
    return FirstTries(True, False, shown, np.zeros(8, np.bool_), np.zeros(8, np.int64))


@given(st.lists(st.sampled_from(list(Action)), min_size=BENT.step_limit, max_size=BENT.step_limit))
def test_it_lands_its_blocks_where_the_real_game_does(actions: list[Action]) -> None:
    cell, placed = BENT.start, list[Cell]()
    for action in actions:
        cell = moved(cell, action, set(placed), BENT.size)
        block = landing(cell, action, set(placed), BENT.size)
        placed += [] if block is None else [block]
        if len(placed) == BENT.blocks:
            break
    left = iter(actions)
    found = expected_landings(ARENA, BENT.start_state, BENT.step_limit, lambda _: next(left), tries_of())
    assert found == placed


def test_the_policy_sees_where_it_is_and_what_is_left() -> None:
    seen: list[State] = []

    def policy(state: State) -> int:
        seen.append(state)
        return int(Action.FD)

    assert expected_landings(ARENA, BENT.start_state, 2, policy, tries_of()) == [(2, 3), (2, 4)][:1]
    assert seen == [(2, 1, 3), (2, 2, 2)]


def test_first_tries_come_before_the_policy() -> None:
    found = expected_landings(ARENA, BENT.start_state, 1, lambda _: int(Action.F), tries_of(Action.RD))
    assert found == [(3, 2)]
