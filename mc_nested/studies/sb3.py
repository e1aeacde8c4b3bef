"""stable-baselines3's DQN on the single agent's task: an episode at a time, with greedy evaluations as the trainer's.

That library takes one gymnasium Env: ten actions, the state (x, y, b, m), MultiDiscrete, which it encodes as one-hot.
"""

import importlib.util
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import MultiDiscrete
from gymnasium.vector import VectorEnv

from mc_nested.arena.env import highest_observation
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arrays import Int64s
from mc_nested.errors import PresetError, RunError, with_extra
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.exploration.schedules import epsilon_after
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.studies.arm import LIBRARY
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import JobOutcome, RunOutcome, evaluated, write_outcome

HOW_TO_INSTALL = with_extra("bench")


def is_installed() -> bool:
    """Return whether the library is installed."""
    return importlib.util.find_spec("stable_baselines3") is not None


CHOSEN = -1
"""Where an observation shows the material: 0 before the choice, then its index + 1."""


class Sb3Env(gymnasium.Env[Int64s, np.int64]):
    """One arena, whose material is chosen by an action of the episode.

    Args:
        arenas: a VectorEnv of that one arena, autoreset disabled.
        scenarios: its scenario.
    """

    def __init__(self, arenas: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario]) -> None:
        self._view = SingleAgentVectorEnv(arenas, scenarios)
        (scenario,) = scenarios
        self.observation_space = MultiDiscrete([*(highest_observation(scenario) + 1), len(scenario.materials) + 1])
        self.action_space = self._view.single_action_space
        self.episodes = 0
        """Episodes that have ended."""
        self.steps = 0
        """Steps of the current episode, or of the one that has just ended."""

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode."""
        super().reset(seed=seed, options=options)
        observations, _ = self._view.reset()
        self.steps = 0
        return observations[0], {}

    def step(self, action: np.int64 | int) -> tuple[Int64s, float, bool, bool, dict[str, Any]]:
        """Take one of the ten actions; the last step's ``info["score"]`` is r_M."""
        observations, rewards, terminated, truncated, info = self._view.step(np.array([action], dtype=np.int64))
        self.steps += 1
        ended = bool(info["_score"][0])
        self.episodes += ended
        beside = {"score": float(info["score"][0])} if ended else {}
        return observations[0], float(rewards[0]), bool(terminated[0]), bool(truncated[0]), beside


class Sb3Dqn:
    """The model; it learns on its own Env, and its random numbers are the process's global ones.

    So nothing else may draw from those while it learns.

    Args:
        env: where it learns.
        preset: the hyper-parameters of its network, replay and update.
        capacity: transitions that its replay keeps.
        seed: of all its random choices.

    Raises:
        RunError: the library isn't installed.
    """

    def __init__(self, env: gymnasium.Env[Int64s, np.int64], preset: Preset, capacity: int, seed: int) -> None:
        if not is_installed():
            raise RunError(f"{LIBRARY} isn't installed: {HOW_TO_INSTALL}")
        from stable_baselines3 import DQN
        from stable_baselines3.common.logger import Logger
        from torch.nn import Tanh

        update = preset.update
        self._model = DQN(
            "MlpPolicy",
            env,
            learning_rate=update.learning_rate,
            buffer_size=capacity,
            learning_starts=update.learning_starts,
            batch_size=update.batch,
            gamma=update.gamma,
            train_freq=1,
            gradient_steps=1,
            target_update_interval=update.target_period,
            policy_kwargs={"net_arch": preset.hidden, "activation_fn": Tanh},
            seed=seed,
            device="cpu",
        )
        self._model.set_logger(Logger(folder=None, output_formats=[]))  # its own makes a folder at each call of learn

    @property
    def updates(self) -> int:
        """Updates so far."""
        return int(self._model._n_updates)

    @property
    def parameters(self) -> int:
        """Parameters of the online network."""
        return sum(parameter.numel() for parameter in self._model.q_net.parameters())

    def learn_a_step(self, epsilon: float) -> None:
        """Take one ε-greedy step in its Env, and one update; a new episode begins by itself after one has ended."""
        self._model.exploration_rate = epsilon
        self._model.exploration_schedule = lambda _: epsilon  # its own falls with steps, of which none knows the total
        self._model.learn(1, reset_num_timesteps=False)

    def greedy(self, observation: Int64s) -> int:
        """Return the greedy action."""
        action, _ = self._model.predict(observation, deterministic=True)
        return int(action)


class Sb3Training:
    """Trains a job of one run, as a JobTraining does. A stopped run starts over, and goes the same way by its seed.

    Args:
        job: what is trained, with the single agent's spec.
        folder: the job's own; made when it is finished.
        arenas: the one arena to learn in.
        others: another of the same, to evaluate in.
        model: what learns.
    """

    def __init__(
        self,
        job: Job,
        folder: Path,
        arenas: VectorEnv[Int64s, Int64s, Any],
        others: VectorEnv[Int64s, Int64s, Any],
        model: type[Sb3Dqn] = Sb3Dqn,
    ) -> None:
        (scenario,), (run,), preset = job.scenarios, job.trials, job.preset
        explore = preset.explore_nested or preset.explore_main
        if explore is None:
            raise PresetError("a library's DQN explores by ε: name a preset with [explore_nested]")
        self.job = job
        self.evaluation_rows: list[EvaluationRow] = []
        self._began = time.thread_time()
        self._folder = folder
        self._scenario = scenario
        self._env, self._evaluation_env = Sb3Env(arenas, job.scenarios), Sb3Env(others, job.scenarios)
        seed = int(np.random.SeedSequence(job.seed, spawn_key=(run,)).generate_state(1)[0])
        capacity = min(preset.replay_capacity, preset.episodes * scenario.step_limit)
        self._model = model(self._env, preset, capacity, seed)
        self._explore = explore
        self._steps = 0

    @property
    def finished(self) -> bool:
        rows, preset = self.evaluation_rows, self.job.preset
        at_optimum = self.job.arm.stop_at_optimum and bool(rows) and rows[-1].score >= self._scenario.optimum
        return at_optimum or self._env.episodes >= preset.episodes

    @property
    def episodes_done(self) -> Int64s:
        return np.array([self._env.episodes])

    @property
    def updates(self) -> int:
        return self._model.updates

    def tick(self) -> None:
        """Play one training episode, and a greedy one if it is due."""
        done, preset = self._env.episodes, self.job.preset
        epsilon = float(epsilon_after(np.array([done]), preset.episodes, self._explore)[0])
        while self._env.episodes == done:
            self._model.learn_a_step(epsilon)
            self._steps += 1
        if (done + 1) % preset.evaluate_every == 0 or done + 1 == preset.episodes:
            self._evaluate()

    def save(self) -> None:
        """Save nothing: a run takes less than a few minutes, and starts over."""

    def finish(self) -> None:
        outcome = JobOutcome(
            identity=fingerprint(self.job.identity()),
            networks=1,
            parameters=self._model.parameters,
            seconds=round(time.thread_time() - self._began, 3),
            runs=[
                RunOutcome(
                    evaluations=[evaluated(row, self._scenario) for row in self.evaluation_rows],
                    score=max(row.score for row in self.evaluation_rows),
                    updates=self._model.updates,
                    env_steps=self._steps,
                )
            ],
        )
        write_outcome(self._folder, outcome)

    def _evaluate(self) -> None:
        env = self._evaluation_env
        observation, _ = env.reset()
        info: dict[str, Any] = {}
        while "score" not in info:
            observation, _, _, _, info = env.step(self._model.greedy(observation))
        material = int(observation[CHOSEN]) - 1
        self.evaluation_rows.append(EvaluationRow(0, self._env.episodes, info["score"], material, env.steps))
