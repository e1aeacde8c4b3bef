"""Trainings by the torch engine: of numbers and of images, resumed to the bit, as good as by the compiled engine."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arrays import Float64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import play_greedily
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import DOT
from tests.learn.made_trainings import assert_same, finish, saved, ticked

LINE = load_scenario("line")
SMALL = replace(DOT, name="small", design=frozenset({(2, 3), (3, 3)}), start=(2, 1), size=5, step_limit=12)
FEW = {"episodes": 12, "evaluate_every": 4}
IMAGE = load_preset("image").model_copy(update=FEW)
TUNED = load_preset("tuned").changed(engine="torch", **FEW)
PAPER = load_preset("paper").changed(engine="torch", episodes=24, evaluate_every=8)


def trainer_of(agent_name: str, preset: Preset, scenarios: Sequence[Scenario], seed: int = 0) -> Trainer:
    agent = Agent(AGENT_SPECS[agent_name], scenarios, preset, seed)
    return Trainer(agent.view_of(GridVectorEnv(scenarios), scenarios), scenarios, agent, preset, seed)


@pytest.mark.parametrize(
    ("agent_name", "preset"),
    [(name, preset) for name in AGENT_SPECS for preset in (IMAGE, PAPER)] + [("nested", TUNED)],
)
def test_a_torch_training_resumes_to_the_bit_and_plays_its_last_evaluation_again(
    agent_name: str, preset: Preset
) -> None:
    scenarios = [SMALL] * 2
    whole, first, resumed = (trainer_of(agent_name, preset, scenarios) for _ in range(3))
    finish(whole)
    resumed.load(*saved(ticked(first, whole.ticks // 2)))
    assert_same(finish(resumed), whole)
    agent = whole.agent
    assert agent.updates > 0
    played = play_greedily(agent.view_of(GridVectorEnv(scenarios), scenarios), scenarios, agent)
    last = {row.trial: row for row in whole.evaluation_rows}
    assert [(each.score, each.material) for each in played] == [
        (last[run].score, last[run].material) for run in range(2)
    ]


@pytest.mark.parametrize("network", ["recurrent", "dropped"])
@pytest.mark.parametrize("runs", [1, 2])
def test_a_users_network_is_trained_in_one_or_two_rows(network: str, runs: int) -> None:
    own = PAPER.changed(network=f"tests.learn.dqn.torch_engine.own_networks:{network}")
    agent = finish(trainer_of("nested", own, [SMALL] * runs)).agent
    assert agent.updates > 0
    first = trainer_of("nested", own, [SMALL] * runs).agent.low_level.engine.online
    assert (np.abs(agent.low_level.engine.online - first).max(axis=1) > 0).all(), "each row has learnt"


def test_a_run_plays_the_same_first_episodes_alone_and_beside_another() -> None:
    # Later they may differ: stacked products add up in another order.
    alone, both = trainer_of("nested", IMAGE, [SMALL]), trainer_of("nested", IMAGE, [SMALL] * 2)
    for trainer in (alone, both):
        ticked(trainer, 40)
    assert alone.episode_rows == [row for row in both.episode_rows if row.trial == 0]


def test_an_image_in_a_replay_takes_one_byte_per_cell_and_plane() -> None:
    trainer = finish(trainer_of("nested", IMAGE, [SMALL]))
    kept = trainer.agent.transitions_since(None)
    assert kept["low.states"].dtype == np.uint8
    assert kept["low.states"].shape == (trainer.env_steps, 2, 5, 5, 5)
    assert kept["main.states"].shape == (12, 2, 4, 5, 5)


def final_scores(preset: Preset, trials: int) -> Float64s:
    trainer = finish(trainer_of("nested", preset, [LINE] * trials, seed=11))
    last = {row.trial: row.score for row in trainer.evaluation_rows}
    return np.array([last[trial] for trial in range(trials)])


def p_of_one_distribution(one: Float64s, other: Float64s) -> float:
    """Return the smaller p of two tests of equal distributions: one of the means, and one of any difference."""
    means = stats.permutation_test((one, other), lambda a, b, axis: a.mean(axis) - b.mean(axis), rng=0).pvalue
    return float(min(means, stats.ks_2samp(one, other).pvalue))


@pytest.mark.slow
def test_final_scores_of_both_engines_on_the_line_have_the_same_distribution() -> None:
    preset = load_preset("paper").model_copy(update={"episodes": 600, "evaluate_every": 600})
    compiled, torch = final_scores(preset, 20), final_scores(preset.changed(engine="torch"), 20)
    assert p_of_one_distribution(compiled, torch) > 0.05
    nearsighted = preset.model_copy(update={"update": preset.update.model_copy(update={"gamma": 0.5})})
    assert p_of_one_distribution(final_scores(nearsighted, 20), torch) < 0.01, "the test tells what differs"
