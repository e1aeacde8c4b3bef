"""In games that aren't what a learnt game takes for granted, the preset model-based learns, or says so and explores."""

import os

import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.trainer import Trainer
from tests.learn.made_trainings import assert_same, copied
from tests.learn.made_worlds import ROW, World, fewest_steps_among, one_wall, trained_in

LINE = load_scenario("line")

SEEDS = range(int(os.environ.get("WORLD_SEEDS", "2")))
"""Of each slow test; the figures in the documentation are of 20: WORLD_SEEDS=20 pytest tests/learn/test_worlds.py."""

SLOWEST = {"line": 14, "zigzag": 14, "diamond": 12}
"""Episodes of the slowest of 20 trials without a wall, the greedy ones included: mc-nested train --preset model-based
--trials 20 --seed 22100 --stop-at-optimum."""


def played(trainer: Trainer) -> int:
    return len(trainer.episode_rows) + len(trainer.evaluation_rows)


def solved(trainer: Trainer, within: int) -> bool:
    """Train until the best score was reached greedily, or so many episodes were played."""
    while not trainer.finished and played(trainer) < within:
        trainer.tick()
    return trainer.finished


def told(trainer: Trainer, within: int = 10) -> list[str]:
    """Return the lines that a training tells within so many episodes."""
    lines: list[str] = []
    while not lines and played(trainer) < within:
        trainer.tick()
        lines = trainer.practice.news()
    return lines


def multiplied(paid: int, material: int) -> float:
    return 3.0 * paid if material == 0 else paid + 10.0


MULTIPLIED = World(score=multiplied, best=3.0 * LINE.blocks)
"""With stone each block brings 1, and the episode 10; with wood each brings 3, and nothing else: 33 against 21."""

BROKEN = {"torus": World(torus=True), "two ahead": World(ahead=2), "before the move": World(block_first=True)}
"""Where the learnt game can't say what happens."""


def test_a_row_of_walls_leaves_the_line_possible() -> None:
    assert fewest_steps_among(ROW, LINE) is not None
    closed = [(x, 13) for x in range(15)]
    assert fewest_steps_among(closed, LINE) is None


def test_a_line_behind_a_row_of_walls_is_built() -> None:
    assert solved(trained_in(World(walls=ROW), LINE, 1), 3 * SLOWEST["line"])


def test_the_material_that_is_best_for_a_whole_design_is_found() -> None:
    trainer = trained_in(MULTIPLIED, LINE, 1)
    assert solved(trainer, 3 * SLOWEST["line"])
    assert trainer.evaluation_rows[-1].material == 0


def test_a_torus_is_told_and_explored_and_goes_on_from_a_checkpoint() -> None:
    trainer = trained_in(BROKEN["torus"], LINE, 1)
    lines = told(trainer)
    assert len(lines) == 1
    assert "\n" not in lines[0]
    assert "doesn't move alike everywhere" in lines[0]
    assert trainer.practice.news() == [], "it is told once"
    for _ in range(100):
        trainer.tick()
    resumed = trained_in(BROKEN["torus"], LINE, 1)
    resumed.load(copied(trainer.state()), [trainer.journal(None)])
    for each in (trainer, resumed):
        for _ in range(400):
            each.tick()
    assert_same(resumed, trainer)
    assert resumed.practice.news() == [], "it was told before"
    policy = max(trainer.evaluation_rows, key=lambda row: row.score)
    assert policy.score > LINE.materials[1].p, "the networks do what the best excursion did"


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("design", ["line", "zigzag", "diamond"])
def test_one_wall_costs_at_most_twice_the_episodes(design: str, seed: int) -> None:
    scenario = load_scenario(design)
    assert solved(trained_in(World(walls=one_wall(scenario, seed)), scenario, seed), 2 * SLOWEST[design])


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_row_of_walls_costs_at_most_three_times_the_episodes(seed: int) -> None:
    assert solved(trained_in(World(walls=ROW), LINE, seed), 3 * SLOWEST["line"])


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_a_score_of_another_form_costs_at_most_three_times_the_episodes(seed: int) -> None:
    assert solved(trained_in(MULTIPLIED, LINE, seed), 3 * SLOWEST["line"])


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("world", BROKEN)
def test_a_game_that_does_not_hold_is_told_within_ten_episodes(world: str, seed: int) -> None:
    assert len(told(trained_in(BROKEN[world], LINE, seed))) == 1
