"""Training R runs of an agent, one tick at a time (paper, Algorithm 1).

A tick is one step of every run that isn't finished: choose, step, store, update. Every run is in an episode of its own:
a training episode, or a greedy evaluation, which isn't counted, stored in a replay or updated on. Where a person acts
instead of the agent, what they did is learnt from, and a greedy evaluation is a training episode from there on: the
policy is evaluated at its next turn. Where builders share
a run's arena, all of them act in a tick, and each is updated. What is learned from a step, and what happens
before an episode, is the preset's practice (practice.py). The trainer sees the arenas only as a gymnasium VectorEnv
with autoreset disabled, so a simulated and a live game look the same to it. The arenas themselves say whether episodes
can be saved half-way.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray

from mc_nested.arena.env import blank_observations
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import INSTEAD, foresees, really_done, resumable_arenas
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s, copied, named_for, part_of
from mc_nested.learn.agents import Agent
from mc_nested.learn.choices import ChoiceStep
from mc_nested.learn.dqn.replay import ReplayMark
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.foresight import announce
from mc_nested.learn.imagination.background_practice import Background, BackgroundThread
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Streams
from mc_nested.learn.training import Training


@dataclass
class _Episodes:
    """Where each run is in its episode; every array is (runs, …), or of all builders."""

    observations: NDArray[Any]
    materials: Int64s
    steps_in_episode: Int64s
    between_episodes: Bools
    evaluating: Bools
    by_hand: Bools
    """Whether a person has acted in it."""


class Trainer(Training):
    """Trains until every run has its episodes: with the same seed, the same training.

    Args:
        env: an arena for each run as a VectorEnv with autoreset disabled, as the agent sees it (``Agent.view_of``);
            with builders, a row for each of them. The other arguments are as ``Training``'s.
        background: where practice runs beside a live game; in a thread unless given.
    """

    def __init__(
        self,
        env: VectorEnv[Any, Int64s, Any],
        scenarios: Sequence[Scenario],
        agent: Agent,
        preset: Preset,
        seed: int,
        stop_at_optimum: bool = False,
        background: Background | None = None,
    ) -> None:
        self._env = env
        self._resumable = resumable_arenas(env)
        beside = None if self._resumable else background or BackgroundThread()
        super().__init__(scenarios, agent, preset, seed, stop_at_optimum, beside)
        runs, builders = len(scenarios), agent.builders
        self._first_builders = slice(None, None, builders)
        self._rollback: EpisodeRollback | None = None
        batch = preset.update.batch
        widths = [CHOICE_NUMBERS, batch, CHOICE_NUMBERS * builders, batch * preset.updates_a_step * builders]
        widths.append(self.practice.numbers)
        ends = [sum(widths[: part + 1]) for part in range(len(widths))]
        self._numbers = [slice(end - width, end) for width, end in zip(widths, ends, strict=True)]
        self._streams = Streams(seed, agent.runs, sum(widths))
        self._episodes = _Episodes(
            observations=blank_observations(env.single_observation_space, runs * builders),
            materials=np.zeros(runs, dtype=np.int64),
            steps_in_episode=np.zeros(runs, dtype=np.int64),
            between_episodes=np.ones(runs, dtype=np.bool_),
            evaluating=np.zeros(runs, dtype=np.bool_),
            by_hand=np.zeros(runs, dtype=np.bool_),
        )

    def tick(self) -> None:
        """Do one step of every run that isn't finished.

        An error of the env passes through; after ``abandon_episodes`` the next tick begins new episodes.
        """
        numbers = self._streams.at(self.ticks)
        main_choice, main_draws, choice, draws, practice = (numbers[:, part] for part in self._numbers)
        self._begin_episodes(main_choice, practice)
        now, running = self._episodes, ~self.runs_finished
        training = running & ~now.evaluating
        states = self.agent.low_level_states(now.observations, now.materials)
        actions = self.agent.act(states, now.materials, self.epsilon[1] * training, choice)
        learning = training.nonzero()[0]  # a quarter of flatnonzero's time, which counts in every tick
        actions = self.practice.act(learning, now.observations, actions, practice)
        takes = self._choices.in_hand(actions, now.materials)
        if foresees(self._env):
            self._announce(takes, training)
        observations, rewards, terminated, truncated, info = self._env.step(takes)
        first = self._first_builders
        if INSTEAD in info:
            actions, by_hand = really_done(actions, info), info[f"_{INSTEAD}"][first]
            now.by_hand |= by_hand
            now.evaluating &= ~by_hand
            training = running & ~now.evaluating
            learning = training.nonzero()[0]
        ended, scores = (terminated | truncated)[first] & running, info["score"][first]
        due = info["chooses"] & ~ended if "chooses" in info else None
        step = ChoiceStep(observations[first], info.get("earned", scores), ended, due, main_draws, self.ticks)
        chosen = self._choices.after(step, now.materials, training, self.epsilon[0])
        done = actions, rewards, observations, chosen, terminated, draws
        self.practice.learn(Step(learning, running, now.observations, now.materials, states, *done))
        now.observations, now.materials = observations, chosen
        now.steps_in_episode += running
        self.env_steps += len(learning)
        self.evaluation_steps += int(np.count_nonzero(now.evaluating & running))
        if ended.any():
            self.practice.end(ended.nonzero()[0], chosen, scores)
            self._end_training_episodes((ended & training).nonzero()[0], scores, step)
            self._end_evaluations((ended & now.evaluating).nonzero()[0], scores)
            now.between_episodes |= ended
        self.ticks += 1

    def abandon_episodes(self) -> None:
        """Start every unfinished episode over: its env is gone or in an unknown state.

        With a single arena, what was learned in its episode is undone: nothing is learned from a mishap.
        """
        if self._rollback and not self._episodes.between_episodes.all():
            self._rollback.restore(self.agent, self.practice)
        self._episodes.between_episodes[:] = True

    def state(self) -> Arrays:
        arenas = self._resumable.snapshot() if self._resumable else {}
        return {**super().state(), **named_for("runs", vars(self._episodes)), **named_for("env", arenas)}

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        super().load(state, journals)
        saved, arenas = part_of(state, "runs"), part_of(state, "env")
        for name, array in vars(self._episodes).items():
            if name in saved:  # not from many games
                array[:] = saved[name]
        if self._resumable and arenas:
            self._resumable.restore(arenas)
        else:
            self.abandon_episodes()

    def _begin_episodes(self, choice: Float64s, practice: Float64s) -> None:
        now = self._episodes
        begins = now.between_episodes & ~self.runs_finished
        runs = begins.nonzero()[0]
        if not len(runs):
            return
        done, evaluated_at = self.episodes_done[runs], self._evaluated_at[runs]
        is_last = done >= self.preset.episodes
        begun_from = evaluated_at < 0  # a policy from elsewhere is evaluated as it is
        due = ((done % self.practice.evaluate_every == 0) | is_last) & (done > evaluated_at)
        self.practice.before_choice(runs[~begun_from])
        now.materials[runs] = self._choices.begin(runs, np.where(due, 0.0, self.epsilon[0][runs]), choice)
        ready = self.practice.before_episode(runs, now.materials, lambda: self._reset(begins))
        now.evaluating[runs] = due & (ready | is_last | begun_from)
        if len(begins) == 1 and self._resumable is None:
            self._rollback = EpisodeRollback.of(self.agent, self.practice)
        self.practice.begin(runs, practice)
        now.steps_in_episode[runs], now.by_hand[runs] = 0, False
        now.between_episodes &= ~begins

    def _announce(self, takes: Int64s, training: Bools) -> None:
        """Announce what comes next in greedy episodes, and in those in which nothing is learnt on the way."""
        known = np.array([not trains or self.practice.is_settled(run) for run, trains in enumerate(training)])
        choice = self._streams.at(self.ticks + 1)[:, self._numbers[2]]
        announce(self._env, self.agent, takes, self._episodes.materials, self.epsilon[1] * training, choice, known)

    def _reset(self, begins: Bools) -> None:
        builders = self.agent.builders
        mask, materials = np.repeat(begins, builders), np.repeat(self._episodes.materials, builders)
        self._episodes.observations, _ = self._env.reset(options={"reset_mask": mask, "material": materials})

    def _end_training_episodes(self, runs: Int64s, scores: Float64s, step: ChoiceStep) -> None:
        if not len(runs):
            return
        now = self._episodes
        self.demonstrated[runs] += now.by_hand[runs]
        self._count_episodes(runs, scores, now.materials, now.steps_in_episode, self.epsilon)
        self._choices.learn(runs, now.materials, step)

    def _end_evaluations(self, runs: Int64s, scores: Float64s) -> None:
        now = self._episodes
        for run in runs.tolist():
            material, steps = int(now.materials[run]), int(now.steps_in_episode[run])
            row = EvaluationRow(run, int(self.episodes_done[run]), float(scores[run]), material, steps)
            self._count_evaluation(row, self.agent.online())


@dataclass(frozen=True)
class EpisodeRollback:
    """The start of an episode, for one that a mishap ends: nothing is learned from it.

    It holds copies of the networks and of what else updates depend on, and the replays' marks.
    """

    agent: Arrays
    practice: Arrays
    marks: Mapping[str, ReplayMark]

    @classmethod
    def of(cls, agent: Agent, practice: Practice) -> "EpisodeRollback":
        """Return a copy of their state now."""
        return cls(copied(agent.state()), copied(practice.state()), agent.mark())

    def restore(self, agent: Agent, practice: Practice) -> None:
        """Put them back into that state."""
        agent.load(self.agent)
        agent.take_back(self.marks)
        practice.load(self.practice)
