"""What a run had spent at each greedy evaluation: steps of training, and updates of all its networks."""

from pathlib import Path

import numpy as np
import pytest

from mc_nested.arrays import Int64s
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.experiments.job_trainers import agents_trainer
from mc_nested.learn.experiments.job_training import JobTraining, outcome_of
from mc_nested.learn.experiments.spent import SpentSoFar
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT, one_job


class FakeTrainer:
    """Two runs; it is its own agent."""

    updates_by_run: Int64s

    def __init__(self) -> None:
        self.episode_rows: list[EpisodeRow] = []
        self.evaluation_rows: list[EvaluationRow] = []
        self.updates_by_run = np.zeros(2, dtype=np.int64)

    @property
    def agent(self) -> "FakeTrainer":
        return self

    def train(self, run: int, steps: int, updates: int) -> None:
        self.episode_rows.append(EpisodeRow(run, 1, 0.0, 0, steps, 0.1, 0.1))
        self.updates_by_run[run] += updates

    def evaluate(self, run: int) -> None:
        self.evaluation_rows.append(EvaluationRow(run, 1, 0.0, 0, 9))


def test_each_evaluation_has_its_own_runs_steps_and_updates() -> None:
    trainer, spent = FakeTrainer(), SpentSoFar(2)
    trainer.train(0, steps=10, updates=7)
    trainer.train(1, steps=20, updates=17)
    spent.count(trainer)
    trainer.train(0, steps=5, updates=5)
    spent.count(trainer)
    trainer.evaluate(0)
    trainer.evaluate(1)
    spent.count(trainer)
    assert spent.at == [(15, 12), (20, 17)]


def test_it_goes_on_from_what_was_saved() -> None:
    trainer, spent = FakeTrainer(), SpentSoFar(2)
    trainer.train(0, steps=10, updates=7)
    trainer.evaluate(0)
    spent.count(trainer)
    again = SpentSoFar(2)
    again.load(spent.state(), trainer)
    trainer.train(0, steps=4, updates=4)
    trainer.evaluate(0)
    again.count(trainer)
    assert again.at == [(10, 7), (14, 11)]


@pytest.mark.parametrize("agent", ["nested", "hierarchical", "single"])
def test_at_its_last_evaluation_a_run_had_spent_all_that_its_outcome_says(agent: str, tmp_path: Path) -> None:
    job = one_job(agent, [DOT, BAR], 2)
    training = JobTraining(job, tmp_path, agents_trainer(job, GridVectorEnv(job.scenarios)))
    while not training.finished:
        training.tick()
    training.finish()
    outcome = outcome_of(job, tmp_path)
    assert outcome
    for run in outcome.runs:
        assert [each.episode for each in run.evaluations] == [5, 10, 15, 20]
        steps = [each.trained_steps or 0 for each in run.evaluations]
        updates = [each.updates or 0 for each in run.evaluations]
        assert (steps[-1], updates[-1]) == (run.env_steps, run.updates)
        assert steps == sorted(set(steps))
        assert updates == sorted(set(updates))
        assert 0 < updates[0] < updates[-1]
