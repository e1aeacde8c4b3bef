"""A learnt game that doesn't hold is noticed, by what its rules can't say; slips and changes are neither."""

from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.learn.imagination.experience import Experience
from mc_nested.learn.imagination.learnt_rules import learn_rules
from mc_nested.learn.imagination.noticing import IN_WORDS, Assumption, broken_assumption, paid_otherwise
from sim.grid import GridGame
from tests.learn.imagination.made_games import BENT, Slipping, play, seen_at_random
from tests.learn.made_worlds import World, WorldGame

OTHER = replace(BENT, design=frozenset({(3, 2), (2, 3), (1, 1)}))

MOVES, SOLID, LANDS, MATERIAL, SLIPS = list(Assumption)[1:]


def noticed(seen: Experience) -> Assumption:
    rules = learn_rules(seen.steps, seen.first_of_episode, len(Action), BENT.size)
    return broken_assumption(rules.astray, seen.first_of_episode)


def astray(*episodes: list[int]) -> Assumption:
    lengths = [len(episode) for episode in episodes]
    return broken_assumption(np.concatenate(episodes).astype(np.int64), np.cumsum([0, *lengths[:-1]]))


def paid(*outcomes: tuple[int, int]) -> list[int]:
    """Return what blocks in one cell speak against, from whether each was paid, and its material."""
    steps = np.array([(2, 1, 3, 4, 2, 2, 2, each, material) for each, material in outcomes])
    return list(paid_otherwise(steps))


def test_one_step_in_each_of_three_episodes_is_noticed_where_nothing_slips() -> None:
    odd, even = [0, 0, SOLID], [0] * 40
    assert astray(odd, even, odd, even, odd) is SOLID
    assert astray(odd, even, odd) is Assumption.HOLDS
    assert astray(odd, odd, *[even] * 9, odd) is Assumption.HOLDS, "ten episodes later it is forgotten"


def test_where_actions_slip_more_than_a_tenth_of_the_steps_of_three_episodes_in_a_row_is_noticed() -> None:
    odd, fair = [SLIPS, LANDS, LANDS, *[0] * 17], [SLIPS, *[0] * 9]
    assert astray(odd, odd, odd) is LANDS
    assert astray(odd, odd) is Assumption.HOLDS
    assert astray(odd, fair, odd, odd) is Assumption.HOLDS
    assert astray(fair, odd, odd, odd) is LANDS


def test_two_steps_that_no_action_makes_are_noticed() -> None:
    assert astray([SLIPS, *[0] * 30, MOVES]) is Assumption.HOLDS
    assert astray([SLIPS, MOVES, *[0] * 30, MOVES]) is MOVES


def test_every_assumption_has_its_words() -> None:
    assert set(IN_WORDS) == set(Assumption) - {Assumption.HOLDS}


def test_a_cell_whose_pay_changes_once_speaks_against_nothing() -> None:
    assert paid((0, 0), (0, 0), (1, 0), (1, 0)) == [0, 0, 0, 0]


def test_a_cell_that_pays_now_and_then_speaks_against_where_blocks_land() -> None:
    assert paid((0, 0), (1, 0), (0, 0), (0, 0), (1, 0)) == [0, 0, LANDS, 0, LANDS]


def test_a_cell_that_pays_with_one_material_alone_speaks_against_paying_with_all() -> None:
    assert paid((0, 0), (1, 1), (0, 0), (1, 1)) == [0, 0, MATERIAL, MATERIAL]


@pytest.mark.parametrize("seed", range(4))
def test_the_real_rules_hold_also_where_one_action_in_twenty_slips(seed: int) -> None:
    assert noticed(seen_at_random(GridGame(BENT), BENT, 20, seed)) is Assumption.HOLDS
    slipping = Slipping(GridGame(BENT), 0.05, np.random.default_rng(seed))
    assert noticed(seen_at_random(slipping, BENT, 20, seed)) is Assumption.HOLDS


@pytest.mark.parametrize("seed", range(4))
def test_a_torus_moves_otherwise_at_its_edges(seed: int) -> None:
    assert noticed(seen_at_random(WorldGame(World(torus=True), BENT), BENT, 20, seed)) is MOVES


def test_a_design_that_changes_breaks_no_assumption() -> None:
    seen, game = Experience(), GridGame(BENT)
    for paying in [BENT] * 3 + [OTHER] * 3:
        play(game, paying, [Action.R, Action.FD, Action.L, Action.FD], seen)
    assert noticed(seen) is Assumption.HOLDS
