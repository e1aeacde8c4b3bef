"""The planner's runs: through reset and step alone, the same for the same seed, given up in time."""

from dataclasses import replace
from pathlib import Path

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.experiments.job_training import outcome_of
from mc_nested.learn.experiments.jobs import PLANNER, Job
from mc_nested.learn.experiments.planner_training import PlannerTraining
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, one_job

ROOMY = replace(BAR, step_limit=30)


def job(episodes: int = 60, trials: int = 2, scenario: Scenario = ROOMY) -> Job:
    return replace(one_job("nested", [scenario], trials, episodes), library=PLANNER, stop_at_optimum=True)


def played(one: Job, folder: Path) -> PlannerTraining:
    training = PlannerTraining(one, folder, GridVectorEnv(one.scenarios))
    while not training.finished:
        training.tick()
    return training


def test_it_finds_a_design_and_its_best_material_and_builds_it(tmp_path: Path) -> None:
    training = played(job(), tmp_path)
    last = [rows[-1] for rows in training.evaluation_rows_of_run]
    assert [(row.score, row.material) for row in last] == [(ROOMY.optimum, 1)] * 2
    assert all(0 < episodes < 60 for episodes in training.episodes_done)


def test_its_outcome_is_a_job_s_outcome_without_networks(tmp_path: Path) -> None:
    one = job()
    played(one, tmp_path).finish()
    outcome = outcome_of(one, tmp_path)
    assert outcome is not None
    assert (outcome.networks, outcome.parameters, [run.updates for run in outcome.runs]) == (0, 0, [0, 0])
    assert [run.score for run in outcome.runs] == [ROOMY.optimum] * 2


def test_a_trial_does_not_depend_on_the_others_beside_it(tmp_path: Path) -> None:
    both = played(job(), tmp_path)
    first = played(job(trials=1), tmp_path)
    assert list(first.evaluation_rows) == list(both.evaluation_rows_of_run[0])
    assert both.evaluation_rows_of_run[0] != both.evaluation_rows_of_run[1]


def test_it_is_given_up_after_its_episodes_with_what_it_can_build(tmp_path: Path) -> None:
    training = played(job(episodes=1), tmp_path)
    assert training.episodes_done.tolist() == [1, 1]
    assert [len(rows) for rows in training.evaluation_rows_of_run] == [1, 1]
    assert all(row.score < ROOMY.optimum for row in training.evaluation_rows)
