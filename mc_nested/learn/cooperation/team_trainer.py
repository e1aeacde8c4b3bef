"""Training R runs of a team, one tick at a time: Algorithm 1 with k nested agents in the loop (paper, section 6).

A tick is one step of every builder of every run that isn't finished: all choose, the arena steps, each stores, each is
updated. Episodes and greedy evaluations follow each other as in learn/trainer.py. With one builder it is that trainer,
to the bit.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.cooperative.single_team import SingleTeamEnv
from mc_nested.arena.cooperative.team_env import TeamEnv, TeamStep
from mc_nested.arena.game import Resumable
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.cooperation.team_agent import Kind, TeamAgent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.exploration.schedules import LinearDecay
from mc_nested.learn.kept_policies import KeptPolicies
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.main_choices import ChoiceStep, MainChoices
from mc_nested.learn.preset import Exploration, Preset
from mc_nested.learn.state_dict import named_for, part_of
from mc_nested.learn.streams import Streams
from mc_nested.learn.training_journal import TrainingJournal


class TeamArena(Protocol):
    """A team's arena as its agents see it: TeamEnv, or SingleTeamEnv for single agents."""

    @property
    def resumable(self) -> Resumable | None:
        """The arena, if its episode can be saved half-way."""

    def reset(self, material: int) -> Int64s:
        """Begin an episode of that material; what each builder sees, (k, …)."""

    def step(self, actions: Int64s) -> TeamStep:
        """One tick, an action of each builder, (k,)."""


def arena_of(within: TeamEnv, networks: Kind) -> TeamArena:
    """A team's arena as agents of that kind see it."""
    return SingleTeamEnv(within) if networks == "single" else within


@dataclass
class _Runs:
    """The progress of each run; every array is (runs, …)."""

    observations: Int64s
    materials: Int64s
    episodes: Int64s
    ticks_in_episode: Int64s
    evaluated_at: Int64s
    between_episodes: Bools
    evaluating: Bools
    finished: Bools


class TeamTrainer:
    """Trains until every run has its episodes.

    Args:
        arenas: an arena for each run.
        agent: what is trained.
        preset: the hyper-parameters; ``episodes`` as in the preset or as asked for.
        seed: of all random choices; the same seed gives the same training.
    """

    def __init__(self, arenas: Sequence[TeamArena], agent: TeamAgent, preset: Preset, seed: int) -> None:
        runs, builders = len(arenas), agent.team.builders
        self.agent = agent
        self.preset = preset
        self.ticks = 0
        self.env_ticks = 0
        self.evaluation_ticks = 0
        self._journal = TrainingJournal(agent)
        self.episode_rows, self.evaluation_rows = self._journal.episodes, self._journal.evaluations
        self._arenas = tuple(arenas)
        self._explore_main, self._explore_nested = _decay(preset.explore_main), _decay(preset.explore_nested)
        self._kept = KeptPolicies(agent)
        scenarios, start = [agent.team.scenario] * runs, agent.main_states(runs)
        self._choices = MainChoices(agent.main, scenarios, start, preset, seed, agent.runs) if agent.main else None
        batch = preset.update.batch
        widths = [CHOICE_NUMBERS, batch, CHOICE_NUMBERS * builders, batch * preset.updates_a_step * builders]
        ends = np.cumsum(widths).tolist()
        self._numbers = [slice(end - width, end) for width, end in zip(widths, ends, strict=True)]
        self._streams = Streams(seed, agent.runs, sum(widths))
        width = 3 + (agent.main is None)
        self._runs = _Runs(
            observations=np.zeros((runs, builders, width), dtype=np.int64),
            materials=np.zeros(runs, dtype=np.int64),
            episodes=np.zeros(runs, dtype=np.int64),
            ticks_in_episode=np.zeros(runs, dtype=np.int64),
            evaluated_at=np.zeros(runs, dtype=np.int64),
            between_episodes=np.ones(runs, dtype=np.bool_),
            evaluating=np.zeros(runs, dtype=np.bool_),
            finished=np.zeros(runs, dtype=np.bool_),
        )

    @property
    def finished(self) -> bool:
        """Whether every run is finished."""
        return bool(self._runs.finished.all())

    @property
    def episodes_done(self) -> Int64s:
        """Training episodes completed, (runs,)."""
        return self._runs.episodes

    @property
    def runs_finished(self) -> Bools:
        """Which runs are finished, (runs,)."""
        return self._runs.finished

    @property
    def kept_scores(self) -> Float64s:
        """The greedy score of the policy that each run keeps, (runs,); -inf before the first evaluation."""
        return self._kept.scores

    @property
    def kept(self) -> Arrays:
        """The networks of the policies that the runs keep, by role, and their ``scores``: what plays afterwards."""
        return {**self._kept.online, "scores": self._kept.scores}

    @property
    def epsilon(self) -> tuple[Float64s, Float64s]:
        """The main and the nested agents' ε of the training episodes now, (runs,) each."""
        done, episodes = self._runs.episodes, self.preset.episodes
        return self._explore_main.epsilon(done, episodes), self._explore_nested.epsilon(done, episodes)

    def tick(self) -> None:
        """One step of every builder of every run that isn't finished; an error of an arena passes through."""
        main_choice, main_draws, choice, draws = (self._streams.at(self.ticks)[:, part] for part in self._numbers)
        self._begin_episodes(main_choice)
        runs = self._runs
        training = ~(runs.finished | runs.evaluating)
        states = self.agent.states(runs.observations, runs.materials)
        actions = self.agent.act(states, np.where(training, self.epsilon[1], 0.0), choice)
        rewards, terminated, truncated, scores = self._step(actions)
        if self.agent.main is None:
            runs.materials = self.agent.chosen_materials(runs.observations)
        rows = np.flatnonzero(training)
        next_states = self.agent.states(runs.observations, runs.materials)
        self.agent.store(rows, states[rows], actions[rows], rewards[rows], next_states[rows], terminated[rows])
        shape = self.agent.team.builders, self.preset.updates_a_step, self.preset.update.batch
        self.agent.learn(rows, draws[rows].reshape(len(rows), *shape))
        runs.ticks_in_episode += ~runs.finished
        self.env_ticks += int(training.sum())
        self.evaluation_ticks += int((runs.evaluating & ~runs.finished).sum())
        ended = (terminated | truncated) & ~runs.finished
        self._end_training_episodes(np.flatnonzero(ended & training), scores, main_draws)
        self._end_evaluations(np.flatnonzero(ended & runs.evaluating), scores)
        runs.between_episodes |= ended
        self.ticks += 1

    def _step(self, actions: Int64s) -> tuple[Float64s, Bools, Bools, Float64s]:
        """Step every run's arena that isn't finished: rewards (runs, k), terminated, truncated, scores (runs,)."""
        runs = self._runs
        rewards, scores = np.zeros(actions.shape), np.zeros(len(actions))
        terminated, truncated = np.zeros(len(actions), dtype=np.bool_), np.zeros(len(actions), dtype=np.bool_)
        runs.observations = runs.observations.copy()  # what was observed before stays as it was
        for run in np.flatnonzero(~runs.finished):
            step = self._arenas[run].step(actions[run])
            runs.observations[run], rewards[run], scores[run] = step.observations, step.rewards, step.score
            terminated[run], truncated[run] = step.terminated, step.truncated
        return rewards, terminated, truncated, scores

    def _begin_episodes(self, choice: Float64s) -> None:
        runs = self._runs
        rows = np.flatnonzero(runs.between_episodes & ~runs.finished)
        if not len(rows):
            return
        done = runs.episodes[rows]
        due = (done % self.preset.evaluate_every == 0) | (done >= self.preset.episodes)
        runs.evaluating[rows] = due & (done > runs.evaluated_at[rows])
        epsilon = np.where(runs.evaluating[rows], 0.0, self.epsilon[0][rows])
        runs.materials[rows] = self._choices.begin(rows, epsilon, choice) if self._choices else 0
        for run in rows:
            runs.observations[run] = self._arenas[run].reset(int(runs.materials[run]))
        runs.ticks_in_episode[rows] = 0
        runs.between_episodes[rows] = False

    def _end_training_episodes(self, rows: Int64s, scores: Float64s, draws: Float64s) -> None:
        if not len(rows):
            return
        runs = self._runs
        main, nested = self.epsilon
        runs.episodes[rows] += 1
        for run in map(int, rows):
            counts = int(runs.materials[run]), int(runs.ticks_in_episode[run])
            played = float(scores[run]), *counts, float(main[run]), float(nested[run])
            self.episode_rows.append(EpisodeRow(run, int(runs.episodes[run]), *played))
        if self._choices:
            every = np.ones(len(scores), dtype=np.bool_)
            step = ChoiceStep(runs.observations[:, 0], scores, every, ~every, draws, self.ticks)
            self._choices.learn(rows, runs.materials, step)

    def _end_evaluations(self, rows: Int64s, scores: Float64s) -> None:
        runs = self._runs
        for run in map(int, rows):
            score, episode = float(scores[run]), int(runs.episodes[run])
            counts = int(runs.materials[run]), int(runs.ticks_in_episode[run])
            self.evaluation_rows.append(EvaluationRow(run, episode, score, *counts))
            runs.evaluated_at[run] = episode
            if self.preset.keep == "last" or score > self._kept.scores[run]:
                self._kept.take(run, score)
            runs.finished[run] = episode >= self.preset.episodes

    def abandon_episodes(self) -> None:
        """Start every unfinished episode over: its arena is gone or in an unknown state."""
        self._runs.between_episodes[:] = True

    def state(self) -> Arrays:
        """What the rest of the training depends on, between two ticks; without the journal."""
        saved = [arena.resumable.snapshot() for arena in self._arenas if arena.resumable]
        arenas = {name: np.stack([each[name] for each in saved]) for name in (saved[0] if saved else {})}
        return {
            "counts": np.array([self.ticks, self.env_ticks, self.evaluation_ticks]),
            **named_for("runs", vars(self._runs)),
            **named_for("arenas", arenas),
            **named_for("agent", self.agent.state()),
            **named_for("kept", self.kept),
        }

    def marks(self) -> Arrays:
        """The length of the journal now: how many rows there are, and how many transitions."""
        return self._journal.marks()

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """The rows and transitions since those marks; all of them if there are none."""
        return self._journal.since(since)

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs."""
        self.ticks, self.env_ticks, self.evaluation_ticks = (int(count) for count in state["counts"])
        for name, kept in part_of(state, "runs").items():
            getattr(self._runs, name)[:] = kept
        self.agent.load(part_of(state, "agent"))
        for name, kept in self.kept.items():
            kept[:] = state[f"kept.{name}"]
        for journal in journals:
            self._journal.extend(journal)
        self._restore_arenas(part_of(state, "arenas"))

    def _restore_arenas(self, saved: Arrays) -> None:
        for run, arena in enumerate(self._arenas):
            if not arena.resumable:
                self.abandon_episodes()
                return
            arena.resumable.restore({name: kept[run] for name, kept in saved.items()})


def _decay(exploration: Exploration | None) -> LinearDecay:
    if exploration is None:  # such a preset was refused by the agent
        raise ValueError("a team explores by ε")
    return LinearDecay(exploration.start, exploration.floor, exploration.share)
