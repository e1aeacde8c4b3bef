"""A training's progress bar: what it says of a training, and no more often than is needed."""

import pytest

from mc_nested.cli import progress as progress_module
from mc_nested.cli.progress import TrainingProgress
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_log import EpisodeRow
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import DOT, small_preset


def trainer() -> Trainer:
    preset = small_preset()
    return Trainer(GridVectorEnv([DOT] * 2), [DOT] * 2, Agent(AGENT_SPECS["nested"], [DOT] * 2, preset, 0), preset, 0)


def figures(progress: TrainingProgress) -> str:
    return str(progress._bar.tasks[0].fields["figures"])


def test_it_says_score_optimum_epsilon_and_updates() -> None:
    training = trainer()
    with TrainingProgress(DOT, training) as progress:
        progress.show()
        assert figures(progress) == "mean score     - of 11  ε 1.00 1.00  0 updates/s"
        training.episode_rows += [EpisodeRow(0, 1, 11.0, 1, 4, 1.0, 1.0), EpisodeRow(1, 1, -5.0, 0, 4, 1.0, 1.0)]
        training.episodes_done[:] = [20, 5]
        progress._next = 0.0
        progress.show()
        assert figures(progress).startswith("mean score   3.0 of 11  ")
        assert progress._bar.tasks[0].completed == 25
        assert progress._bar.tasks[0].total == 40


def test_a_finished_run_counts_whole_and_the_bar_is_not_refreshed_too_often(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress_module, "REFRESH_S", 1000.0)
    training = trainer()
    with TrainingProgress(DOT, training) as progress:
        progress.show()
        training.episodes_done[:] = [3, 5]
        training.runs_finished[0] = True
        progress.show()
        assert progress._bar.tasks[0].completed == 0
    assert progress._bar.tasks[0].completed == 20 + 5
