"""Training by a model that isn't ours: episodes, greedy evaluations, the end at the optimum, and the outcome."""

from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.experiments.benchmark import baseline
from mc_nested.learn.experiments.job_training import OUTCOME, JobOutcome, TrainedJob, outcome_of
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.experiments.sb3_training import Sb3Training
from sim.grid import GridVectorEnv
from tests.learn.experiments.made_model import MadeModel
from tests.learn.made_experiments import BAR


class NeverKnows(MadeModel):
    knows_after = 1000


def job(episodes: int = 40, run: int = 4) -> Job:
    preset = baseline().preset.model_copy(update={"episodes": episodes, "evaluate_every": 5})
    return Job("0", AGENT_SPECS["single"], preset, ("sb3, dqn",), (BAR,), (run,), 3, True, "stable-baselines3")


def training(folder: Path, own: Job | None = None, model: type[MadeModel] = MadeModel) -> Sb3Training:
    return Sb3Training(own or job(), folder, GridVectorEnv([BAR]), GridVectorEnv([BAR]), model)


def trained(own: TrainedJob) -> JobOutcome:
    while not own.finished:
        own.tick()
    own.finish()
    outcome = outcome_of(own.job, Path(own._folder))  # type: ignore[attr-defined]  # its folder is its own
    assert outcome
    return outcome


def test_it_ends_at_the_first_greedy_episode_at_the_optimum(tmp_path: Path) -> None:
    own = training(tmp_path / "job")
    outcome = trained(own)
    (run,) = outcome.runs
    assert [row.episode for row in run.evaluations] == [5, 10, 15]
    assert [row.score for row in run.evaluations] == [10.0, 10.0, BAR.optimum]
    assert [row.material for row in run.evaluations] == ["stone"] * 3
    assert run.evaluations[0].steps == BAR.step_limit
    assert run.score == BAR.optimum
    assert own.episodes_done.tolist() == [15]
    assert run.env_steps == run.updates == own.updates
    assert (outcome.networks, outcome.parameters) == (1, 7)
    assert [path.name for path in (tmp_path / "job").iterdir()] == [OUTCOME]


def test_it_gives_up_at_its_cap_and_evaluates_once_more_there(tmp_path: Path) -> None:
    outcome = trained(training(tmp_path / "job", job(episodes=12), NeverKnows))
    assert [row.episode for row in outcome.runs[0].evaluations] == [5, 10, 12]


def test_a_job_that_is_stopped_starts_over_and_goes_the_same_way(tmp_path: Path) -> None:
    straight = trained(training(tmp_path / "straight"))
    stopped = training(tmp_path / "stopped")
    for _ in range(7):
        stopped.tick()
    stopped.save()
    assert trained(training(tmp_path / "stopped")).runs == straight.runs


def test_epsilon_falls_with_the_episodes_and_every_run_has_a_seed_of_its_own(tmp_path: Path) -> None:
    own = training(tmp_path, job(episodes=40), NeverKnows)
    model = own._model
    assert isinstance(model, MadeModel)
    while not own.finished:
        own.tick()
    assert model.epsilons[0] == 1.0
    assert model.epsilons == sorted(model.epsilons, reverse=True)
    assert model.epsilons[-1] == pytest.approx(0.05)
    assert model.capacity == 40 * BAR.step_limit
    other = training(tmp_path, job(run=5), NeverKnows)._model
    assert isinstance(other, MadeModel)
    assert other.seed != model.seed


def test_a_full_disk_is_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = training(tmp_path)
    while not own.finished:
        own.tick()

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    with pytest.raises(RunError, match=r"No space left on device.*: make room"):
        own.finish()
