"""Training by a model that isn't ours: episodes, greedy evaluations, the end at the optimum, and the outcome."""

import sys
from pathlib import Path

import pytest
from gymnasium.spaces import Discrete, MultiDiscrete

from mc_nested.arena.builder import build
from mc_nested.errors import RunError
from mc_nested.studies import sb3
from mc_nested.studies.arm import SB3, Arm, Run
from mc_nested.studies.benchmark import baseline
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME, JobOutcome, outcome_of
from mc_nested.studies.sb3 import Sb3Dqn, Sb3Env, Sb3Training
from sim.grid import GridVectorEnv
from tests.full_disk import full_disk
from tests.learn.made_experiments import BAR, DOT
from tests.studies.made_model import MadeModel


class NeverKnows(MadeModel):
    knows_after = 1000


def job(episodes: int = 40, run: int = 4) -> Job:
    preset = baseline().model_copy(update={"episodes": episodes, "evaluate_every": 5})
    arm = Arm("sb3, dqn", preset, (), 1, SB3, stop_at_optimum=True)
    return Job("0", (Run(arm, BAR, run),), seed=3)


def training(folder: Path, own: Job | None = None, model: type[MadeModel] = MadeModel) -> Sb3Training:
    return Sb3Training(own or job(), folder, GridVectorEnv([BAR]), GridVectorEnv([BAR]), model)


def trained(own: Sb3Training) -> JobOutcome:
    while not own.finished:
        own.tick()
    own.finish()
    outcome = outcome_of(own.job, own._folder)
    assert outcome
    return outcome


def test_an_sb3_training_ends_at_the_first_greedy_episode_at_the_optimum(tmp_path: Path) -> None:
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


def test_an_sb3_training_ends_at_its_cap_with_one_more_evaluation(tmp_path: Path) -> None:
    outcome = trained(training(tmp_path / "job", job(episodes=12), NeverKnows))
    assert [row.episode for row in outcome.runs[0].evaluations] == [5, 10, 12]


def test_a_stopped_sb3_job_starts_over_and_has_the_same_outcome(tmp_path: Path) -> None:
    straight = trained(training(tmp_path / "straight"))
    stopped = training(tmp_path / "stopped")
    for _ in range(7):
        stopped.tick()
    stopped.save()
    assert trained(training(tmp_path / "stopped")).runs == straight.runs


def test_epsilon_falls_with_the_episodes_and_every_run_has_its_own_seed(tmp_path: Path) -> None:
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


def test_a_full_disk_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = training(tmp_path)
    while not own.finished:
        own.tick()

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(RunError, match=r"no space left on the disk.*: make room"):
        own.finish()


def env() -> Sb3Env:
    return Sb3Env(GridVectorEnv([BAR]), [BAR])


def test_the_sb3_env_has_ten_actions_and_discrete_values_of_x_y_b_and_m() -> None:
    assert env().action_space == Discrete(10)
    assert env().observation_space == MultiDiscrete([15, 15, 4, 3])
    assert env().observation_space.contains(env().reset()[0])


def test_the_builder_earns_the_optimum() -> None:
    own = env()
    observation, _ = own.reset()
    assert observation.tolist() == [*BAR.start, 3, 0]
    earned = []
    for action in [1, *(2 + int(action) for action in build(BAR))]:
        observation, reward, terminated, truncated, info = own.step(action)
        assert own.observation_space.contains(observation)
        earned.append(reward)
    assert (terminated, truncated) == (True, False)
    assert info == {"score": BAR.optimum}
    assert sum(earned) == BAR.optimum
    assert (own.episodes, own.steps) == (1, 1 + len(build(BAR)))


def test_a_first_action_that_chooses_no_material_ends_the_episode_with_score_0() -> None:
    own = Sb3Env(GridVectorEnv([DOT]), [DOT])
    own.reset()
    _, reward, terminated, _, info = own.step(5)
    assert (reward, terminated, info) == (0.0, True, {"score": 0.0})


def test_a_long_episode_is_truncated() -> None:
    own = env()
    own.reset()
    flags = [own.step(1)[2:4] for _ in range(BAR.step_limit)]
    assert flags[-1] == (False, True)
    assert not any(truncated for _, truncated in flags[:-1])


def test_missing_stable_baselines3_is_reported_with_the_install_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sb3, "is_installed", lambda: False)
    monkeypatch.setitem(sys.modules, "stable_baselines3", None)  # importing it would raise another error
    with pytest.raises(RunError, match=r"stable-baselines3 isn't installed: install .*\.\[bench\]"):
        Sb3Dqn(Sb3Env(GridVectorEnv([DOT]), [DOT]), baseline(), 100, 0)


@pytest.mark.slow
def test_the_library_learns_a_step_at_a_time_and_chooses_greedily() -> None:
    preset = baseline()
    env = Sb3Env(GridVectorEnv([BAR]), [BAR])
    model = Sb3Dqn(env, preset, capacity=1000, seed=3)
    steps = preset.update.learning_starts + 20
    for _ in range(steps):
        model.learn_a_step(epsilon=1.0)
    assert 19 <= model.updates <= 20
    assert env.episodes > 0
    inputs, hidden = 15 + 15 + (BAR.blocks + 1) + (len(BAR.materials) + 1), preset.hidden[0]
    assert model.parameters == (inputs + 1) * hidden + (hidden + 1) * hidden + (hidden + 1) * 10
    choices = {model.greedy(env.reset()[0]) for _ in range(3)}
    assert len(choices) == 1
