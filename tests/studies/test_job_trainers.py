"""A job's trainer: of agents as ever, of a team as cooperate trains it."""

from dataclasses import replace
from pathlib import Path

import pytest

from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.cooperative.team_env import TeamEnv
from mc_nested.learn.cooperation.team_agent import Kind
from mc_nested.learn.cooperation.team_trainer import TeamArena, arena_of
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.studies.job import Builders, Job
from mc_nested.studies.job_trainers import team_trainer
from mc_nested.studies.job_training import JobTraining
from mc_nested.studies.outcome import JobOutcome, outcome_of
from sim.team_grid import TeamGrid
from tests.learn.made_experiments import BAR, one_job


def arenas(team: Team, networks: Kind, runs: int) -> list[TeamArena]:
    return [arena_of(TeamEnv(TeamGrid(team), team), networks) for _ in range(runs)]


def team_job(builders: int, networks: Kind, trials: tuple[int, ...] = (0, 1)) -> Job:
    job = replace(one_job("nested", [BAR], len(trials)), builders=Builders(builders, networks))
    return replace(job, trials=trials)


def train(job: Job, folder: Path, stopped_at: int | None = None) -> JobOutcome:
    training = JobTraining(job, folder, team_trainer(job, arenas))
    ticks = 0
    while not training.finished:
        training.tick()
        ticks += 1
        if ticks == stopped_at:
            training.save()
            training = JobTraining(job, folder, team_trainer(job, arenas))
    training.finish()
    outcome = outcome_of(job, folder)
    assert outcome
    return outcome


@pytest.mark.parametrize("networks", ["shared", "own", "single"])
def test_a_team_is_trained_the_same_however_often_it_is_stopped(networks: Kind, tmp_path: Path) -> None:
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


def test_a_job_without_builders_is_no_teams() -> None:
    with pytest.raises(ValueError, match="no builders"):
        team_trainer(one_job("nested", [BAR], 1), arenas)
