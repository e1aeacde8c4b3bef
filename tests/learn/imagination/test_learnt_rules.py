"""The learnt rules are the true ones, whatever those are, also where actions slip."""

import numpy as np
import pytest

from mc_nested.arena.action import Action, Cell
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.learnt_rules import LearntRules, learn_rules, unclear_moves
from sim.grid import GridGame
from tests.learn.imagination.made_games import (
    BENT,
    TRUE_MOVES,
    TRUE_PLACES,
    MadeUpGame,
    Slipping,
    assert_rules,
    play,
    seen_at_random,
)
from tests.learn.made_worlds import World, WorldGame

SWAPPED = [TRUE_MOVES[at] for at in (1, 0, 2, 3, 4, 5, 6, 7)]


def learnt(seen: Experience) -> LearntRules:
    return learn_rules(seen.steps, seen.first_of_episode, len(Action), BENT.size)


def explained_by(*actions: Action) -> LearntRules:
    """Return the rules learnt from one episode of these actions alone."""
    seen = Experience()
    play(GridGame(BENT), BENT, actions, seen)
    return learnt(seen)


@pytest.mark.parametrize("seed", range(8))
def test_random_actions_show_the_true_rules(seed: int) -> None:
    assert_rules(learnt(seen_at_random(GridGame(BENT), BENT, 20, seed)), TRUE_MOVES, TRUE_PLACES, (0, 1))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("lands", [(1, 0), (-1, -1), (0, -1)])
def test_rules_other_than_the_real_ones_are_learnt_correctly(lands: tuple[int, int], seed: int) -> None:
    places = TRUE_PLACES[::-1]
    game = MadeUpGame(SWAPPED, places, lands, BENT)
    assert_rules(learnt(seen_at_random(game, BENT, 30, seed)), SWAPPED, places, lands)


@pytest.mark.parametrize("seed", range(4))
def test_the_true_rules_are_learnt_when_one_action_in_twenty_slips(seed: int) -> None:
    slips = np.random.default_rng(100 + seed)
    real = Slipping(GridGame(BENT), 0.05, slips)
    assert_rules(learnt(seen_at_random(real, BENT, 40, seed)), TRUE_MOVES, TRUE_PLACES, (0, 1))
    other = Slipping(MadeUpGame(SWAPPED, TRUE_PLACES, (1, 0), BENT), 0.05, slips)
    assert_rules(learnt(seen_at_random(other, BENT, 40, seed)), SWAPPED, TRUE_PLACES, (1, 0))


def test_a_block_that_stops_the_next_step_shows_where_it_landed() -> None:
    # From (2, 1) to (2, 2); its block could have landed in any of the eight cells around. The second FD is stopped, not
    # at the edge: the block is ahead. One transition can't tell, and no fewer than two do.
    assert explained_by(Action.FD).lands != (0, 1)
    assert explained_by(Action.FD, Action.FD).lands == (0, 1)


def test_a_stopped_sideways_step_shows_a_block_beside_the_agent() -> None:
    # R is known to lead to the right; beside the block it is stopped, far from the edge.
    seen = Experience()
    game = MadeUpGame(TRUE_MOVES, TRUE_PLACES, (1, 0), BENT)
    play(game, BENT, [Action.L, Action.R, Action.L, Action.FD, Action.R], seen)
    assert learnt(seen).lands == (1, 0)


def test_a_step_stopped_at_the_edge_is_not_taken_for_a_block() -> None:
    at_edge = explained_by(Action.FD, Action.FD, *[Action.B] * 4)
    assert at_edge.moves[Action.B].tolist() == [0, -1]
    assert at_edge.known.tolist() == [action in (Action.FD, Action.B) for action in Action]
    assert at_edge.lands == (0, 1)
    assert not at_edge.places[Action.B], "it was tried where a block could land"


def test_an_action_that_was_never_tried_is_taken_to_place_a_block() -> None:
    assert learnt(Experience()).places.all()
    assert not learnt(Experience()).known.any()
    tried = explained_by(Action.F, Action.FD)
    assert tried.places.tolist() == [action is not Action.F for action in Action]


def test_a_try_where_no_block_could_land_does_not_count_against_an_action() -> None:
    # Once at (2, 3), whose block is in (2, 4), FD stays there and can't place again: four tries void, one not.
    rules = explained_by(Action.F, *[Action.FD] * 5)
    assert rules.places[Action.FD]
    assert rules.lands == (0, 1)


def test_a_failed_placement_at_the_edge_shows_that_blocks_land_ahead() -> None:
    # Along the far edge RD places nothing: were it not ahead that blocks land, it would have.
    to_the_edge, along_it, back = [Action.F] * 3, [Action.RD] * 2, [Action.B, Action.LD, Action.B, Action.RD]
    assert explained_by(*to_the_edge, *along_it, *back).lands[1] == 1


def test_blocks_of_one_episode_do_not_count_in_the_next() -> None:
    seen = Experience()
    game = GridGame(BENT)
    play(game, BENT, [Action.FD, Action.FD], seen)
    for _ in range(3):
        play(game, BENT, [Action.F, Action.F], seen)
    assert learnt(seen).lands == (0, 1)
    as_one_episode = learn_rules(seen.steps, np.array([0]), len(Action), BENT.size)
    assert not learnt(seen).astray.any()
    assert as_one_episode.astray.any(), "each walk through the old block would speak against it"


def moved(*steps: tuple[Action, int, int]) -> np.ndarray[tuple[int, int], np.dtype[np.int64]]:
    """Return transitions from (2, 2) by these actions, each with the step that it made."""
    return np.array([(2, 2, 4, action, 2 + right, 2 + forward, 4, 0, 0) for action, right, forward in steps])


def unclear(*steps: tuple[Action, int, int]) -> list[Action]:
    return [Action(int(at)) for at in np.flatnonzero(unclear_moves(moved(*steps), len(Action)))]


def test_one_step_makes_a_move_clear_when_nothing_slips() -> None:
    assert unclear((Action.L, -1, 0), (Action.B, 0, -1), (Action.L, 0, 0)) == []


def test_a_move_needs_a_lead_of_two_to_be_clear_when_actions_slip() -> None:
    slipped = (Action.L, -1, 0), (Action.L, -1, 0), (Action.L, -1, 0), (Action.L, 0, 1)
    once, twice = (Action.B, -1, 0), ((Action.R, 1, 0), (Action.R, 1, 0))
    assert unclear(*slipped, once, *twice) == [each for each in Action if each not in (Action.L, Action.R)]
    assert Action.L in unclear(*slipped, (Action.L, 0, 1))


def walled(*walls: Cell) -> WorldGame:
    return WorldGame(World(walls=frozenset(walls)), BENT)


def walls_of(seen: Experience) -> set[Cell]:
    return {(int(x), int(y)) for x, y in np.argwhere(learnt(seen).walls)}


def test_a_cell_that_stops_a_move_though_nothing_was_built_there_is_a_wall() -> None:
    seen = Experience()
    play(walled((2, 3)), BENT, [Action.F, Action.F], seen)
    assert walls_of(seen) == {(2, 3)}


def test_an_edge_and_a_block_of_ones_own_are_no_walls() -> None:
    seen = Experience()
    play(GridGame(BENT), BENT, [Action.B, Action.B, Action.FD, Action.F, Action.F], seen)
    assert walls_of(seen) == set()


def test_a_cell_where_a_block_does_not_land_is_a_wall() -> None:
    # RD is known to place a block; ahead of (3, 2), at (3, 3), it doesn't.
    seen, game = Experience(), walled((3, 3))
    for actions in ([Action.FD, Action.FD], [Action.RD], [Action.RD], [Action.F, Action.RD]):
        play(game, BENT, actions, seen)
    assert walls_of(seen) == {(3, 3)}
    assert learnt(seen).places[Action.RD]


def test_a_wall_that_was_entered_later_is_free() -> None:
    seen = Experience()
    play(walled((2, 3)), BENT, [Action.F, Action.F], seen)
    play(GridGame(BENT), BENT, [Action.F, Action.F], seen)
    assert walls_of(seen) == set()
    play(walled((2, 3)), BENT, [Action.F, Action.F], seen)
    assert walls_of(seen) == {(2, 3)}, "and a wall again, once it stops again"


@pytest.mark.parametrize(("stops", "walls"), [(1, 0), (2, 1)])
def test_where_actions_slip_one_stop_is_a_slip_and_two_are_a_wall(stops: int, walls: int) -> None:
    seen = Experience()
    for _ in range(2):
        play(GridGame(BENT), BENT, [Action.R, Action.F], seen)
    seen.begin()
    seen.add(RealStep(2, 1, 3, Action.R, 2, 2, 3, 0, 0))  # R does what F does
    for _ in range(stops):
        play(walled((4, 1)), BENT, [Action.R, Action.R], seen)
    assert len(walls_of(seen)) == walls


@pytest.mark.parametrize("seed", range(8))
def test_walls_do_not_change_where_blocks_are_thought_to_land(seed: int) -> None:
    walls = {(1, 3), (3, 3), (2, 4)}
    seen = seen_at_random(walled(*walls), BENT, 20, seed)
    assert_rules(learnt(seen), TRUE_MOVES, TRUE_PLACES, (0, 1))
    assert walls_of(seen) <= walls
    assert not learnt(seen).astray.any(), "walls explain it all"
