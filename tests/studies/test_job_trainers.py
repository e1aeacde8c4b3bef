"""A job's trainer, of several builders in an arena."""

from dataclasses import replace
from pathlib import Path

import pytest

from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.learn.builders import Networks
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.studies.job import Builders, Job
from mc_nested.studies.job_trainers import agents_trainer, team_of_job
from mc_nested.studies.job_training import JobTraining
from mc_nested.studies.outcome import JobOutcome, outcome_of
from sim.team_grid import TeamGrid
from tests.learn.made_experiments import BAR, one_job


def team_job(builders: int, networks: Networks, trials: tuple[int, ...] = (0, 1)) -> Job:
    job = replace(one_job("nested", [BAR], len(trials)), builders=Builders(builders, networks))
    return replace(job, trials=trials)


def train(job: Job, folder: Path, stopped_at: int | None = None) -> JobOutcome:
    team = team_of_job(job)
    assert team

    def begun() -> JobTraining:
        arenas = TeamVectorEnv([TeamGrid(team) for _ in job.trials], team)
        return JobTraining(job, folder, agents_trainer(job, arenas))

    training = begun()
    ticks = 0
    while not training.finished:
        training.tick()
        ticks += 1
        if ticks == stopped_at:
            training.save()
            training = begun()
    training.finish()
    outcome = outcome_of(job, folder)
    assert outcome
    return outcome


@pytest.mark.parametrize("networks", ["shared", "own", "single"])
def test_a_team_is_trained_the_same_however_often_it_is_stopped(networks: Networks, tmp_path: Path) -> None:
    job = team_job(2, networks)
    whole, stopped = train(job, tmp_path / "whole"), train(job, tmp_path / "stopped", stopped_at=41)
    assert whole.runs == stopped.runs
    assert (whole.networks, whole.parameters) == (stopped.networks, stopped.parameters)
    assert all(run.evaluations[-1].updates == run.updates > 0 for run in whole.runs)
    assert all(run.evaluations[-1].trained_steps == run.env_steps > 0 for run in whole.runs)
    assert all((run.replay_bytes or 0) > 0 for run in whole.runs)


def test_a_trial_is_the_same_whatever_trains_beside_it(tmp_path: Path) -> None:
    both, alone = team_job(2, "own"), team_job(2, "own", trials=(1,))
    assert train(both, tmp_path / "both").runs[1] == train(alone, tmp_path / "alone").runs[0]


def test_builders_are_part_of_what_is_trained() -> None:
    jobs = [
        team_job(2, "shared"),
        team_job(3, "shared"),
        team_job(2, "own"),
        replace(team_job(2, "own"), builders=None),
    ]
    assert len({fingerprint(job.identity()) for job in jobs}) == 4
    assert jobs[-1].identity()["builders"] is None


def test_a_job_without_builders_has_no_team() -> None:
    assert team_of_job(one_job("nested", [BAR], 1)) is None
