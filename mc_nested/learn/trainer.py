"""Training R runs of an agent, one tick at a time (paper, Algorithm 1).

A tick is one step of every run that isn't finished: choose, step, store, update. Every run is in an episode of its own:
a training episode, or a greedy evaluation, which isn't counted, stored in a replay or updated on. In presets with
excursions a greedy evaluation is learned from in another way: what its actions did is remembered, and if it is the best
episode so far, excursions follow it and updates imitate it. The trainer sees the arenas only as
a gymnasium VectorEnv with autoreset disabled, so a simulated and a live game look the same to it. The arenas
themselves say whether episodes can be saved half-way.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray

from mc_nested.arena.env import blank_observations
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import resumable_arenas
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.episode_rollback import EpisodeMemory, EpisodeRollback
from mc_nested.learn.exploration.batched_return_then_explore import NUMBERS, BatchedReturnThenExplore
from mc_nested.learn.exploration.schedules import decays_of
from mc_nested.learn.imagination.background_practice import Background, BackgroundPractice, BackgroundThread
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.kept_policies import KeptPolicies
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.main_choices import ChoiceStep, MainChoices
from mc_nested.learn.preset import Preset
from mc_nested.learn.state_dict import named_for, part_of
from mc_nested.learn.streams import Streams
from mc_nested.learn.training_journal import TrainingJournal


@dataclass
class _Runs:
    """The progress of each run; every array is (runs, …)."""

    observations: NDArray[Any]
    materials: Int64s
    episodes: Int64s
    steps_in_episode: Int64s
    evaluated_at: Int64s
    between_episodes: Bools
    evaluating: Bools
    finished: Bools


class Trainer:
    """Trains until every run has its episodes.

    Args:
        env: R arenas as a VectorEnv with autoreset disabled; for the single agent, in its ten-action view.
        scenarios: each run's scenario.
        agent: what is trained.
        preset: the hyper-parameters; ``episodes`` as in the preset or as asked for.
        seed: of all random choices; the same seed gives the same training.
        stop_at_optimum: finish a run at its first greedy evaluation at its scenario's optimum.
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
        runs = len(scenarios)
        self.agent = agent
        self.preset = preset
        self.ticks = 0
        self.env_steps = 0
        self.evaluation_steps = 0
        self._journal = TrainingJournal(agent)
        self.episode_rows, self.evaluation_rows = self._journal.episodes, self._journal.evaluations
        self._env = env
        self._resumable = resumable_arenas(env)
        self._rollback: EpisodeRollback | None = None
        self._stop_at_optimum = stop_at_optimum
        self._optimum = np.array([scenario.optimum for scenario in scenarios])
        start = agent.start_states(scenarios)
        self._choices = MainChoices(agent.main, scenarios, start, preset, seed, agent.runs) if agent.main else None
        self._explore = decays_of(preset)
        self._explorer = BatchedReturnThenExplore(preset.excursions, agent, scenarios) if preset.excursions else None
        self._imagination = agent.imagination(scenarios, preset, seed)
        plays_on = self._imagination is not None and self._resumable is None
        self._beside_the_game = BackgroundPractice(background or BackgroundThread()) if plays_on else None
        self._kept = KeptPolicies(agent)
        batch, exploring = preset.update.batch, NUMBERS if preset.excursions else 0
        widths = [CHOICE_NUMBERS, batch, CHOICE_NUMBERS, batch * preset.updates_a_step, exploring]
        ends = [sum(widths[: part + 1]) for part in range(len(widths))]
        self._numbers = [slice(end - width, end) for width, end in zip(widths, ends, strict=True)]
        self._streams = Streams(seed, agent.runs, sum(widths))
        self._runs = _Runs(
            observations=blank_observations(env.single_observation_space, runs),
            materials=np.zeros(runs, dtype=np.int64),
            episodes=np.zeros(runs, dtype=np.int64),
            steps_in_episode=np.zeros(runs, dtype=np.int64),
            evaluated_at=np.zeros(runs, dtype=np.int64),
            between_episodes=np.ones(runs, dtype=np.bool_),
            evaluating=np.zeros(runs, dtype=np.bool_),
            finished=np.zeros(runs, dtype=np.bool_),
        )
        self._epsilon = self._epsilon_now()

    @property
    def _recorders(self) -> dict[str, EpisodeMemory]:
        """What remembers past episodes beside the replays, by its name in a checkpoint."""
        parts = {"explorer": self._explorer, "imagination": self._imagination}
        return {name: part for name, part in parts.items() if part is not None}

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
        """The main and the nested agent's ε of the training episodes now, (runs,) each."""
        return self._epsilon

    @property
    def imagination(self) -> Imagination | None:
        """What the runs have learnt of their games; None if the preset has no [imagination]."""
        return self._imagination

    def begin_from(self, online: Mapping[str, NDArray[Any]], *, evaluated_first: bool = True) -> None:
        """Begin with one run's networks, by role, in every run.

        They are evaluated before the first episode if so wished; with an imagination, if they build all of a design
        that is known (``Imagination.begin_from``).
        """
        self.agent.load_online(online)
        self._kept.take_all()
        self._runs.evaluated_at[:] = -1 if evaluated_first else 0

    def tick(self) -> None:
        """One step of every run that isn't finished.

        An error of the env passes through; after ``abandon_episodes`` the next tick begins new episodes.
        """
        numbers = self._streams.at(self.ticks)
        main_choice, main_draws, nested_choice, nested_draws, exploring = (numbers[:, part] for part in self._numbers)
        self._begin_episodes(main_choice, exploring)
        runs = self._runs
        training = ~(runs.finished | runs.evaluating)
        states = self.agent.low_level_states(runs.observations, runs.materials)
        epsilon = self.epsilon[1] * training
        actions = self.agent.act(states, runs.materials, epsilon, nested_choice)
        rows = training.nonzero()[0]  # a quarter of flatnonzero's time, which counts in every tick
        if self._explorer:
            actions[rows] = self._explorer.act(rows, runs.observations, exploring)
        if self._imagination:
            actions[rows] = self._imagination.act(rows, actions)
        observations, rewards, terminated, truncated, info = self._env.step(
            self._choices.in_hand(actions, runs.materials) if self._choices else actions
        )
        ended = (terminated | truncated) & ~runs.finished
        chosen, step = runs.materials, ChoiceStep.of(observations, info, ended, main_draws, self.ticks)
        if self._choices and "chooses" in info and step.due.any():
            epsilon = np.where(training, self.epsilon[0], 0.0)
            chosen = self._choices.again(step, chosen, training, epsilon)
        if self._imagination:
            active = np.flatnonzero(~runs.finished)
            self._imagination.observe(active, runs.observations, runs.materials, actions, rewards, observations)
        else:
            next_states = self.agent.low_level_states(observations, chosen)
            self._learn(rows, states, actions, rewards, next_states, terminated, nested_draws)

        runs.observations = observations
        runs.materials = chosen if self.agent.main else self.agent.chosen_materials(observations)
        runs.steps_in_episode += ~runs.finished
        self.env_steps += len(rows)
        self.evaluation_steps += int(np.count_nonzero(runs.evaluating & ~runs.finished))
        if ended.any():
            if self._explorer:
                self._explorer.end(np.flatnonzero(ended))
            if self._imagination:
                self._imagination.end(np.flatnonzero(ended), runs.materials, info["score"])
            self._end_training_episodes((ended & training).nonzero()[0], info["score"], step)
            self._end_evaluations((ended & runs.evaluating).nonzero()[0], info["score"])
            runs.between_episodes |= ended
        self.ticks += 1

    def _learn(
        self,
        rows: Int64s,
        states: NDArray[Any],
        actions: Int64s,
        rewards: Float64s,
        next_states: NDArray[Any],
        terminated: Bools,
        draws: Float64s,
    ) -> None:
        """Store the step of the named runs, observe it, and update from the replay; every array is of all runs."""
        runs, preset = self._runs, self.preset
        learners = self.agent.low_level_rows(rows, runs.materials)
        seen = states[rows], actions[rows], rewards[rows], next_states[rows], terminated[rows]
        self.agent.low_level.store(learners, *seen)
        if self._explorer:
            active = np.flatnonzero(~runs.finished)
            before, seen_after = runs.observations[active], (rewards[active], next_states[active], terminated[active])
            acted = self.agent.low_level_rows(active, runs.materials)
            self._explorer.observe(active, before, states[active], actions[active], *seen_after, acted)
        of_rows = draws.take(rows, axis=0).reshape(len(rows), preset.updates_a_step, preset.update.batch)
        for update in range(preset.updates_a_step):
            self.agent.low_level.learn(learners, of_rows[:, update])

    def abandon_episodes(self) -> None:
        """Start every unfinished episode over: its env is gone or in an unknown state.

        With a single arena, what was learned in its episode is undone: nothing is learned from a mishap.
        """
        if self._rollback and not self._runs.between_episodes.all():
            self._rollback.restore(self.agent, self._recorders)
        self._runs.between_episodes[:] = True

    def state(self) -> Arrays:
        """What the rest of the training depends on, between two ticks; without the journal."""
        return {
            "counts": np.array([self.ticks, self.env_steps, self.evaluation_steps]),
            **named_for("runs", vars(self._runs)),
            **named_for("env", self._resumable.snapshot() if self._resumable else {}),
            **named_for("agent", self.agent.state()),
            **named_for("kept", self.kept),
            **named_for("choices", self._choices.state() if self._choices else {}),
            **{k: v for name, part in self._recorders.items() for k, v in named_for(name, part.state()).items()},
        }

    def marks(self) -> Arrays:
        """The length of the journal now: how many rows there are, and how many transitions."""
        return self._journal.marks()

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """The rows and transitions since those marks; all of them if there are none."""
        return self._journal.since(since)

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs."""
        self.ticks, self.env_steps, self.evaluation_steps = (int(count) for count in state["counts"])
        for name, kept in part_of(state, "runs").items():
            getattr(self._runs, name)[:] = kept
        self._epsilon = self._epsilon_now()
        self.agent.load(part_of(state, "agent"))
        for name, kept in self.kept.items():
            kept[:] = state[f"kept.{name}"]
        if self._choices:
            self._choices.load(part_of(state, "choices"))
        for name, recorder in self._recorders.items():
            recorder.load(part_of(state, name))
        for journal in journals:
            self._journal.extend(journal)
        arenas = part_of(state, "env")
        if self._resumable and arenas:
            self._resumable.restore(arenas)
        else:
            self.abandon_episodes()

    def _begin_episodes(self, choice: Float64s, exploring: Float64s) -> None:
        runs = self._runs
        begins = runs.between_episodes & ~runs.finished
        rows = begins.nonzero()[0]
        if not len(rows):
            return
        episodes, evaluated_at = runs.episodes[rows], runs.evaluated_at[rows]
        due = (episodes % self.preset.evaluate_every == 0) | (episodes >= self.preset.episodes)
        runs.evaluating[rows] = due & (episodes > evaluated_at)
        begun_from = evaluated_at < 0  # a policy from elsewhere is evaluated as it is
        self._learn_choices(rows[~begun_from])
        if self._choices:
            epsilon = np.where(runs.evaluating[rows], 0.0, self.epsilon[0][rows])
            runs.materials[rows] = self._choices.begin(rows, epsilon, choice)
        if self._imagination:
            builds_it_all = self._practise_and_reset(self._imagination, rows, begins)
            anyway = (episodes >= self.preset.episodes) | begun_from
            runs.evaluating[rows] = builds_it_all & (episodes > evaluated_at) | anyway
        else:
            self._reset(begins)
        if self._beside_the_game:
            self._beside_the_game.during_episode()
        if len(begins) == 1 and self._resumable is None:
            self._rollback = EpisodeRollback.of(self.agent, self._recorders)
        if self._explorer:
            self._explorer.begin(rows, exploring)
        if self._imagination:
            self._imagination.begin(rows)
        runs.steps_in_episode[begins] = 0
        runs.between_episodes &= ~begins

    def _learn_choices(self, rows: Int64s) -> None:
        if self._beside_the_game:
            self._beside_the_game.end_of_episode()
        if self._imagination:
            for run in map(int, rows):
                self._imagination.learn_choice(run)

    def _practise_and_reset(self, imagination: Imagination, rows: Int64s, begins: Bools) -> Bools:
        """Practise the named runs (k,) and reset their arenas; which ones' policies build all of a known design, (k,).

        A simulated game is reset after the practice, a live one meanwhile.
        """
        materials = {int(run): int(self._runs.materials[run]) for run in rows}
        if self._beside_the_game is None:
            practised = [imagination.practise(run, material) for run, material in materials.items()]
            self._reset(begins)
        else:
            sessions = {run: imagination.session(run, material) for run, material in materials.items()}
            self._beside_the_game.during_reset(sessions, lambda: self._reset(begins))
            practised = [imagination.builds_it_all(run, session) for run, session in sessions.items()]
        return np.array(practised, dtype=np.bool_)

    def _reset(self, begins: Bools) -> None:
        options = {"reset_mask": begins, "material": self._runs.materials}
        self._runs.observations, _ = self._env.reset(options=options)

    def _end_training_episodes(self, rows: Int64s, scores: Float64s, step: ChoiceStep) -> None:
        if not len(rows):
            return
        runs = self._runs
        epsilon_main, epsilon_nested = self.epsilon
        runs.episodes[rows] += 1
        self._epsilon = self._epsilon_now()
        told = runs.episodes, scores, runs.materials, runs.steps_in_episode, epsilon_main, epsilon_nested
        self.episode_rows += map(EpisodeRow, rows.tolist(), *(of_all[rows].tolist() for of_all in told))
        if self._choices and not self._imagination:
            self._choices.learn(rows, runs.materials, step)

    def _epsilon_now(self) -> tuple[Float64s, Float64s]:
        """``epsilon``, for as long as no training episode ends: every tick needs it."""
        main, nested = self._explore
        done, episodes = self._runs.episodes, self.preset.episodes
        return main.epsilon(done, episodes), nested.epsilon(done, episodes)

    def _end_evaluations(self, rows: Int64s, scores: Float64s) -> None:
        runs = self._runs
        for run in rows:
            score, episode = float(scores[run]), int(runs.episodes[run])
            steps, material = int(runs.steps_in_episode[run]), int(runs.materials[run])
            self.evaluation_rows.append(EvaluationRow(int(run), episode, score, material, steps))
            runs.evaluated_at[run] = episode
            if self.preset.keep == "last" or score > self._kept.scores[run]:
                self._kept.take(run, score)
            reached = self._stop_at_optimum and score >= self._optimum[run]
            runs.finished[run] = episode >= self.preset.episodes or reached
