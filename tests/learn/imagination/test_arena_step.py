"""The learnt game's step: edges, blocks and landings as in the real rules; and the landings expected of an episode."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.learn.imagination.arena_step import (
    NOWHERE,
    ImaginedArena,
    ImaginedTask,
    State,
    cell_at,
    epsilon_from,
    expected_landings,
    imagined_arena,
    index_of,
    is_wasted,
    state_at,
    step,
)
from mc_nested.learn.imagination.beliefs import Belief, Beliefs, believe, evidence_of
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.learnt_rules import LearntRules
from tests.learn.imagination.made_games import BENT, TRUE_MOVES, TRUE_PLACES
from tests.learn.imagination.made_practice import arena_of

SIZE = 5


def taught_arena(
    moves: list[Cell] = TRUE_MOVES, places: list[bool] = TRUE_PLACES, lands: Cell = (0, 1), paying: Cell = (2, 3)
) -> ImaginedArena:
    pay = np.zeros((SIZE, SIZE), np.float32)
    pay[paying] = 1.0
    rules = LearntRules(
        np.array(moves),
        np.ones(len(moves), np.bool_),
        np.array(places),
        lands,
        np.zeros((SIZE, SIZE), np.bool_),
        np.zeros(0, np.int64),
    )
    return imagined_arena(rules, Beliefs(np.full((SIZE, SIZE), Belief.UNKNOWN, np.int8), pay, True, 1.0))


@given(st.integers(0, 4), st.integers(0, 4), st.integers(1, 4))
def test_every_cell_has_an_index_inside_the_border(x: int, y: int, longest: int) -> None:
    arena = taught_arena([(longest, 0), (0, -longest)], [False, True])
    assert arena.border == longest
    assert arena.side == SIZE + 2 * longest
    assert cell_at(index_of((x, y), arena), arena) == (x, y)
    assert not arena.empty[index_of((x, y), arena)]
    assert np.count_nonzero(~arena.empty) == SIZE * SIZE
    assert arena.empty[NOWHERE]
    assert arena.pay[NOWHERE] == 0.0


def test_the_imagined_arena_pays_in_the_cell_that_the_beliefs_name() -> None:
    arena = taught_arena(paying=(4, 1))
    assert arena.pay[index_of((4, 1), arena)] == 1.0
    assert arena.pay.sum() == 1.0


def test_rules_without_moves_keep_the_agent_in_place_and_place_blocks() -> None:
    arena = taught_arena([(0, 0)] * 8, [True] * 8, (-1, -1))
    solid = arena.empty.copy()
    at = index_of((2, 2), arena)
    position, block = step(arena, at, int(Action.F), solid)
    assert (position, cell_at(block, arena)) == (at, (1, 1))


@pytest.mark.parametrize("action", Action)
def test_an_edge_stops_a_step_and_voids_a_block(action: Action) -> None:
    arena = taught_arena()
    for corner in [(0, 0), (0, 4), (4, 0), (4, 4)]:
        solid = arena.empty.copy()
        position, block = step(arena, index_of(corner, arena), int(action), solid)
        cell = moved(corner, action, (), SIZE)
        assert cell_at(position, arena) == cell
        placed = landing(cell, action, (), SIZE)
        assert (None if block == NOWHERE else cell_at(block, arena)) == placed
        assert np.count_nonzero(solid != arena.empty) == (placed is not None)


def test_a_long_move_that_would_end_outside_is_stopped() -> None:
    arena = taught_arena([(0, 3), (3, 0), (-2, 0)], [False] * 3)
    solid = arena.empty.copy()
    for start, action, end in [((2, 1), 0, (2, 4)), ((2, 2), 0, (2, 2)), ((4, 4), 1, (4, 4)), ((1, 0), 2, (1, 0))]:
        assert cell_at(step(arena, index_of(start, arena), action, solid)[0], arena) == end


def test_a_placed_block_stops_steps_and_further_blocks() -> None:
    arena = taught_arena()
    solid = arena.empty.copy()
    start = index_of((2, 1), arena)
    position, block = step(arena, start, int(Action.FD), solid)
    assert (cell_at(position, arena), cell_at(block, arena)) == ((2, 2), (2, 3))
    assert step(arena, position, int(Action.FD), solid) == (position, NOWHERE)
    assert step(arena, position, int(Action.F), solid) == (position, NOWHERE)


def test_a_block_can_land_to_the_side() -> None:
    arena = taught_arena(lands=(1, 0))
    position, block = step(arena, index_of((2, 1), arena), int(Action.LD), arena.empty.copy())
    assert (cell_at(position, arena), cell_at(block, arena)) == ((1, 1), (2, 1))


@given(st.lists(st.sampled_from(Action), max_size=60))
def test_the_imagined_arena_with_the_true_rules_steps_as_the_rules_do(actions: list[Action]) -> None:
    arena = taught_arena()
    solid, cell, placed = arena.empty.copy(), (2, 1), set[Cell]()
    position = index_of(cell, arena)
    for action in actions:
        position, block = step(arena, position, int(action), solid)
        cell = moved(cell, action, placed, SIZE)
        lands = landing(cell, action, placed, SIZE)
        placed |= {lands} if lands else set()
        assert (cell_at(position, arena), None if block == NOWHERE else cell_at(block, arena)) == (cell, lands)


TRUE_RULES = LearntRules(
    np.array(TRUE_MOVES),
    np.ones(8, np.bool_),
    np.array(TRUE_PLACES),
    (0, 1),
    np.zeros((5, 5), np.bool_),
    np.zeros(0, np.int64),
)
ARENA = imagined_arena(
    TRUE_RULES, believe(evidence_of(np.zeros((0, 9), np.int64), (0, 1), BENT.size), (0, 1), BENT.blocks)
)


def tries_of(untried: int | None = None) -> FirstTries:
    shown = np.arange(8) == untried
    return FirstTries(True, False, False, shown, np.zeros(8, np.bool_), np.zeros(8, np.int64))


@given(st.lists(st.sampled_from(list(Action)), min_size=BENT.step_limit, max_size=BENT.step_limit))
def test_expected_landings_are_those_of_the_real_game(actions: list[Action]) -> None:
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


def test_expected_landings_show_the_policy_its_cell_and_the_blocks_left() -> None:
    seen: list[State] = []

    def policy(state: State) -> int:
        seen.append(state)
        return int(Action.FD)

    assert expected_landings(ARENA, BENT.start_state, 2, policy, tries_of()) == [(2, 3), (2, 4)][:1]
    assert seen == [(2, 1, 3), (2, 2, 2)]


def test_first_tries_come_before_the_policy() -> None:
    found = expected_landings(ARENA, BENT.start_state, 1, lambda _: int(Action.F), tries_of(Action.RD))
    assert found == [(3, 2)]


def test_a_states_index_is_made_of_its_cell_its_blocks_and_the_tasks_offset() -> None:
    arena = arena_of()
    task = ImaginedTask(index_of(BENT.start, arena), 3, 14, 3.0, np.array([20, 4, 1]), 1000)
    assert state_at(index_of((3, 2), arena), 2, arena, task) == 3 * 20 + 2 * 4 + 2 + 1000


def test_only_a_block_in_an_unpaid_cell_is_wasted() -> None:
    arena = arena_of()
    assert is_wasted(index_of((0, 1), arena), arena)
    assert not is_wasted(index_of((2, 3), arena), arena)
    assert not is_wasted(NOWHERE, arena)


def test_epsilon_is_drawn_on_a_logarithmic_scale() -> None:
    assert epsilon_from(0.0, 1.0, 0.01) == pytest.approx(0.01)
    assert epsilon_from(0.5, 1.0, 0.01) == pytest.approx(0.1)
    assert epsilon_from(0.25, 0.3, 0.3) == pytest.approx(0.3)
