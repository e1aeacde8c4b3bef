"""Training one run by stable-baselines3's DQN: an episode at a time, with greedy evaluations as the trainer's."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol

import gymnasium
import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arrays import Int64s
from mc_nested.errors import PresetError
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.experiments.job_training import JobOutcome, RunOutcome, evaluated, write_outcome, writing
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.experiments.sb3_env import Sb3Env
from mc_nested.learn.experiments.sb3_model import Sb3Dqn
from mc_nested.learn.exploration.schedules import LinearDecay
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.checkpoint import fingerprint

CHOSEN = -1
"""Where an observation shows the material: 0 before the choice, then its index + 1."""


class Model(Protocol):
    """What learns: sb3_model.py says what each does."""

    @property
    def updates(self) -> int: ...

    @property
    def parameters(self) -> int: ...

    def learn_a_step(self, epsilon: float) -> None: ...

    def greedy(self, observation: Int64s) -> int: ...


MakeModel = Callable[[gymnasium.Env[Int64s, np.int64], Preset, int, int], Model]
"""A model from its Env, the preset, the capacity of its replay and a seed."""


class Sb3Training:
    """Trains a job of one run. A stopped run starts over, and goes the same way: its seed decides all.

    Args:
        job: what is trained, with the single agent's spec.
        folder: the job's own; made when it is finished.
        arenas: the one arena to learn in.
        others: another of the same, to evaluate in.
        make_model: what learns.
    """

    def __init__(
        self,
        job: Job,
        folder: Path,
        arenas: VectorEnv[Int64s, Int64s, Any],
        others: VectorEnv[Int64s, Int64s, Any],
        make_model: MakeModel = Sb3Dqn,
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
        self._model = make_model(self._env, preset, capacity, seed)
        self._decay = LinearDecay(explore.start, explore.floor, explore.share)
        self._steps = 0

    @property
    def finished(self) -> bool:
        rows, preset = self.evaluation_rows, self.job.preset
        at_optimum = self.job.stop_at_optimum and bool(rows) and rows[-1].score >= self._scenario.optimum
        return at_optimum or self._env.episodes >= preset.episodes

    @property
    def episodes_done(self) -> Int64s:
        return np.array([self._env.episodes])

    @property
    def updates(self) -> int:
        return self._model.updates

    def tick(self) -> None:
        """One training episode, and a greedy one if it is due."""
        done, preset = self._env.episodes, self.job.preset
        epsilon = float(self._decay.epsilon(np.array([done]), preset.episodes)[0])
        while self._env.episodes == done:
            self._model.learn_a_step(epsilon)
            self._steps += 1
        if (done + 1) % preset.evaluate_every == 0 or done + 1 == preset.episodes:
            self._evaluate()

    def save(self) -> None:
        """Nothing: a run takes less than a few minutes, and starts over."""

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
        with writing(self._folder):
            write_outcome(self._folder, outcome)

    def _evaluate(self) -> None:
        env = self._evaluation_env
        observation, _ = env.reset()
        info: dict[str, Any] = {}
        while "score" not in info:
            observation, _, _, _, info = env.step(self._model.greedy(observation))
        material = int(observation[CHOSEN]) - 1
        self.evaluation_rows.append(EvaluationRow(0, self._env.episodes, info["score"], material, env.steps))
