"""Jobs that train the same however they are cut and however often they are stopped, alone and with several builders."""

import re
import shutil
from pathlib import Path

import pytest

from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.errors import RunError
from mc_nested.learn.builders import Networks
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.studies.arm import Arm, Run
from mc_nested.studies.job import Job, cut_into_jobs
from mc_nested.studies.job_training import JobTraining, agents_trainer, team_of_job
from mc_nested.studies.outcome import OUTCOME, JobOutcome, RunOutcome, outcome_of
from sim.grid import GridVectorEnv
from sim.team_grid import TeamGrid
from tests.full_disk import full_disk
from tests.learn.made_experiments import BAR, DOT, one_job, runs_of, small_preset


def training(job: Job, folder: Path) -> JobTraining:
    return JobTraining(job, folder, agents_trainer(job, GridVectorEnv(job.scenarios)))


def train(job: Job, folder: Path) -> JobOutcome:
    own = training(job, folder)
    while not own.trainer.finished:
        own.tick()
    own.finish()
    outcome = outcome_of(job, folder)
    assert outcome
    return outcome


@pytest.mark.parametrize(
    ("agent", "encoding"),
    [("nested", "scaled"), ("hierarchical", "scaled"), ("single", "scaled"), ("nested", "one-hot")],
)
def test_the_outcome_does_not_depend_on_the_cut_into_jobs(agent: str, encoding: str, tmp_path: Path) -> None:
    runs = runs_of([agent], [DOT, BAR], 3, small_preset().model_copy(update={"encoding": encoding}))
    found: list[dict[tuple[str, int], RunOutcome]] = []
    for parts in (1, 4):
        found.append({})
        for job in cut_into_jobs(runs, parts, seed=3):
            outcome = train(job, tmp_path / f"{parts}" / job.name)
            keys = [(scenario.name, trial) for scenario, trial in zip(job.scenarios, job.trials, strict=True)]
            found[-1].update(zip(keys, outcome.runs, strict=True))
    assert found[0] == found[1]
    assert len(found[0]) == 6
    assert found[0]["bar", 0] != found[0]["bar", 1]


def test_an_outcome_holds_evaluations_steps_updates_and_replay_bytes(tmp_path: Path) -> None:
    job = one_job("nested", [DOT, BAR], 2)
    outcome = train(job, tmp_path)
    assert [row.episode for row in outcome.runs[0].evaluations] == [5, 10, 15, 20]
    assert outcome.networks == 2
    assert outcome.seconds > 0
    for scenario, run in zip(job.scenarios, outcome.runs, strict=True):
        # An update a step from the fourth transition on, and one an episode for the main agent, likewise.
        assert run.updates == (run.env_steps - 3) + (20 - 3)
        assert 20 <= run.env_steps <= 20 * scenario.step_limit
        assert {row.material for row in run.evaluations} <= {"wood", "stone"}
        assert run.score == run.evaluations[-1].score
        # Of each step, and of the main agent's each episode: two indices of two bytes, action 1, reward 4, discount 4.
        assert run.replay_bytes == 13 * (run.env_steps + 20)


def test_the_single_agents_replay_bytes_count_its_steps_alone(tmp_path: Path) -> None:
    for run in train(one_job("single", [DOT, BAR], 1), tmp_path).runs:
        assert run.replay_bytes == 13 * run.env_steps


def test_a_job_with_a_damaged_checkpoint_begins_anew_once_its_folder_is_deleted(tmp_path: Path) -> None:
    job, folder = one_job("nested", [DOT], 1), tmp_path / "007"
    straight = train(job, tmp_path / "straight")
    own = training(job, folder)
    own.tick()
    own.save()
    next((folder / "checkpoint").glob("*.npz")).write_bytes(b"cut short")
    with pytest.raises(RunError, match=f"damaged or cut short: delete {re.escape(str(folder))}, and this job alone"):
        training(job, folder)
    shutil.rmtree(folder)
    assert train(job, folder).runs == straight.runs


def test_a_killed_run_loses_less_than_an_evaluation_interval(tmp_path: Path) -> None:
    job = one_job("nested", [DOT, BAR], 2, episodes=50)
    own = training(job, tmp_path)
    for tick in range(200):
        own.tick()
        if tick % 20 == 0 and (tmp_path / "checkpoint").exists():
            lost = own.trainer.episodes_done - training(job, tmp_path).trainer.episodes_done
            assert lost.min() >= 0
            assert lost.max() < job.preset.evaluate_every
    assert own.trainer.episodes_done.max() > 3 * job.preset.evaluate_every


def test_a_job_stopped_repeatedly_has_the_same_outcome(tmp_path: Path) -> None:
    job = one_job("hierarchical", [DOT, BAR], 2)
    straight = train(job, tmp_path / "straight")
    own = training(job, tmp_path / "stopped")
    ticks = 0
    while not own.trainer.finished:
        own.tick()
        ticks += 1
        if ticks % 37 == 0:
            own.save()
            own = training(job, tmp_path / "stopped")
        elif ticks % 50 == 0:  # a kill: what came after the last save is done again
            own = training(job, tmp_path / "stopped")
    assert own.trainer.finished
    own.finish()
    stopped = outcome_of(job, tmp_path / "stopped")
    assert stopped
    assert stopped.runs == straight.runs


def test_a_finished_job_leaves_only_its_outcome_on_disk(tmp_path: Path) -> None:
    job = one_job("nested", [DOT], 1)
    assert outcome_of(job, tmp_path / "job") is None
    train(job, tmp_path / "job")
    assert [path.name for path in (tmp_path / "job").iterdir()] == [OUTCOME]


def test_an_outcome_of_another_job_or_half_of_one_is_refused(tmp_path: Path) -> None:
    job = one_job("nested", [DOT], 1)
    train(job, tmp_path)
    with pytest.raises(RunError, match="belongs to another experiment"):
        outcome_of(one_job("nested", [DOT], 1, episodes=21), tmp_path)
    whole = (tmp_path / OUTCOME).read_bytes()
    (tmp_path / OUTCOME).write_bytes(whole[: len(whole) // 2])
    with pytest.raises(RunError, match="remove it to train that again") as caught:
        outcome_of(job, tmp_path)
    assert "\n" not in str(caught.value)


def test_a_full_disk_is_reported_and_keeps_the_last_save(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    job = one_job("nested", [DOT], 2, episodes=50)
    own = training(job, tmp_path)
    while (own.trainer.episodes_done < 14).all():
        own.tick()
    saved = training(job, tmp_path).episodes_done.tolist()
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full_disk)
        with pytest.raises(RunError, match=r"no space left on the disk.*: make room"):
            own.save()
    assert training(job, tmp_path).episodes_done.tolist() == saved
    assert min(saved) > 0


@pytest.mark.parametrize("agent", ["nested", "hierarchical", "single"])
def test_the_last_evaluation_has_the_outcomes_total_steps_and_updates(agent: str, tmp_path: Path) -> None:
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


def team_job(builders: int, networks: Networks, trials: tuple[int, ...] = (0, 1)) -> Job:
    arm = Arm("nested", small_preset(), (), len(trials), builders=builders, networks=networks)
    return Job("000", tuple(Run(arm, BAR, trial) for trial in trials), seed=3)


def train_untouched(job: Job, folder: Path, stopped_at: int | None = None) -> JobOutcome:
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
def test_a_team_stopped_and_resumed_has_the_same_outcome(networks: Networks, tmp_path: Path) -> None:
    job = team_job(2, networks)
    whole, stopped = train_untouched(job, tmp_path / "whole"), train_untouched(job, tmp_path / "stopped", stopped_at=41)
    assert whole.runs == stopped.runs
    assert (whole.networks, whole.parameters) == (stopped.networks, stopped.parameters)
    assert all(run.evaluations[-1].updates == run.updates > 0 for run in whole.runs)
    assert all(run.evaluations[-1].trained_steps == run.env_steps > 0 for run in whole.runs)
    assert all((run.replay_bytes or 0) > 0 for run in whole.runs)


def test_a_team_trial_has_the_same_outcome_alone_and_beside_another(tmp_path: Path) -> None:
    both, alone = team_job(2, "own"), team_job(2, "own", trials=(1,))
    assert train_untouched(both, tmp_path / "both").runs[1] == train_untouched(alone, tmp_path / "alone").runs[0]


def test_a_jobs_identity_includes_its_builders() -> None:
    jobs = [
        team_job(2, "shared"),
        team_job(3, "shared"),
        team_job(2, "own"),
        one_job("nested", [BAR], 2),
    ]
    assert len({fingerprint(job.identity()) for job in jobs}) == 4
    assert jobs[-1].identity()["builders"] is None


def test_a_job_without_builders_has_no_team() -> None:
    assert team_of_job(one_job("nested", [BAR], 1)) is None
