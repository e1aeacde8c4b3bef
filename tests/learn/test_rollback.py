"""A rollback restores networks, practice and replay to what they were at the start of the episode."""

import numpy as np
import pytest

from mc_nested.arrays import Arrays
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import ExcursionRule, Preset
from mc_nested.learn.trainer import EpisodeRollback, Trainer
from sim.grid import GridVectorEnv
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_experiments import small_preset

PAPERS = small_preset()
RETURNS = PAPERS.model_copy(
    update={
        "explore_nested": None,
        "excursions": ExcursionRule(at_end=0.1, wander=3, rejoin=0.4, repeat=0.8),
    }
)


def state_of(trainer: Trainer) -> Arrays:
    state = {**trainer.agent.state(), **{f"practice.{k}": kept for k, kept in trainer.practice.state().items()}}
    return {name: array.copy() for name, array in state.items()}


@pytest.mark.parametrize(
    ("preset", "remembers"),
    [(PAPERS, None), (RETURNS, "0.effects"), (SMALL, "0.steps")],
    ids=["none", "returns", "imagines"],
)
def test_a_rollback_undoes_everything_an_episode_taught(preset: Preset, remembers: str | None) -> None:
    trainer = Trainer(GridVectorEnv([BENT]), [BENT], Agent(AGENT_SPECS["nested"], [BENT], preset, 0), preset, 0)
    while len(trainer.episode_rows) < 2:
        trainer.tick()
    before, kept = EpisodeRollback.of(trainer.agent, trainer.practice), state_of(trainer)
    held = trainer.agent.low_level.replay.added.copy()
    while len(trainer.episode_rows) < 3:
        trainer.tick()
    changed = {name for name, array in state_of(trainer).items() if not np.array_equal(array, kept[name])}
    assert remembers is None or f"practice.{remembers}" in changed
    assert "low.online" in changed
    before.restore(trainer.agent, trainer.practice)
    for name, array in state_of(trainer).items():
        np.testing.assert_array_equal(array, kept[name], err_msg=name)
    assert trainer.agent.low_level.replay.added.tolist() == held.tolist()
