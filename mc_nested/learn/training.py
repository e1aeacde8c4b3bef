"""Training: R runs of an agent while they train, and all that a folder, a summary, a view and a resume need of them.

Who trains has the episodes played: tick by tick in arenas of this process (trainer.py), or whole, by games (games/).
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Float64s, Int64s, copied, named_for, part_of
from mc_nested.learn.agents import Agent
from mc_nested.learn.choices import ChoiceStep, MainChoices, OwnChoices
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow, rows_of_table, table_of_rows
from mc_nested.learn.exploration.return_then_explore import Excursions
from mc_nested.learn.exploration.schedules import decays_of, epsilon_after
from mc_nested.learn.imagination.background_practice import Background
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.learnt_game import LearntGame, imagination_of
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Purpose, stream
from mc_nested.learn.unknown_design import Tries, UnknownDesigns
from mc_nested.learn.whole_episode import WholeEpisode


class Training:
    """What R runs of an agent have come to.

    ``env_steps`` and ``evaluation_steps`` count the steps of training episodes and of greedy evaluations, of all runs;
    ``episode_rows`` and ``evaluation_rows`` have a row for each. ``episodes_done`` are training episodes, (runs,), of
    which so many were ``demonstrated``, in part at least: a person acted, or they were learnt from elsewhere.
    ``runs_finished`` says which runs are finished. ``policies`` are the networks that the runs keep, by
    role: what plays afterwards; and their ``scores``, (runs,), at the greedy evaluations that they are from, -inf
    before the first one. ``epsilon`` is the main and the nested agent's ε of the training episodes now, (runs,) each:
    every tick needs it, so it is computed when an episode ends.

    Args:
        scenarios: each run's scenario.
        agent: what is trained.
        preset: the hyper-parameters; ``episodes`` as in the preset or as asked for.
        seed: of all random choices.
        stop_at_optimum: finish a run at its first greedy evaluation at its scenario's optimum.
        background: where practice runs beside a live game; None where the game waits for it.
    """

    def __init__(
        self,
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
        self.ticks = self.env_steps = self.evaluation_steps = 0
        self.episode_rows: list[EpisodeRow] = []
        self.evaluation_rows: list[EvaluationRow] = []
        self.episodes_done = np.zeros(runs, dtype=np.int64)
        self.demonstrated = np.zeros(runs, dtype=np.int64)
        self.runs_finished = np.zeros(runs, dtype=np.bool_)
        self.policies: Arrays = {**copied(agent.online()), "scores": np.full(runs, -np.inf)}
        self.practice = practice_of(agent, scenarios, preset, seed, background)
        main = agent.main
        self._seed = seed
        self._choices = MainChoices(agent, main, scenarios, preset, seed) if main else OwnChoices(agent)
        self._decays = decays_of(preset)
        self.epsilon = self._epsilon_now()
        self._evaluated_at = np.zeros(runs, dtype=np.int64)
        self._optimum = np.array([scenario.optimum for scenario in scenarios])
        self._stop_at_optimum = stop_at_optimum

    @property
    def finished(self) -> bool:
        """Whether every run is finished."""
        return bool(self.runs_finished.all())

    @property
    def policy_scores(self) -> Float64s:
        """The greedy score of the policy that each run keeps, (runs,)."""
        return self.policies["scores"]

    def begin_from(self, online: Mapping[str, NDArray[Any]], *, evaluated_first: bool = True) -> None:
        """Begin with one run's networks, by role, in every run.

        They are evaluated before the first episode if so wished; with an imagination, if they build all of a design
        that is known (``Imagination.begin_from``).
        """
        self.agent.load_online(online)
        self.policies |= copied(self.agent.online())
        self._evaluated_at[:] = -1 if evaluated_first else 0

    def learn_from(self, shown: WholeEpisode) -> None:
        """Learn in every run from an episode that was played elsewhere: it counts as a training episode of now."""
        runs, steps, tick = np.arange(len(self.episodes_done)), len(shown.actions), self.ticks
        randoms = [stream(Purpose.DEMONSTRATIONS, self._seed, run, tick) for run in self.agent.runs]
        self._learn_whole(shown, randoms, runs)
        self.demonstrated += 1
        self.env_steps += steps * len(runs)
        columns = ([shown.earned[-1]], [shown.materials[-1]], [steps])
        scores, materials, each = (np.repeat(column, len(runs)) for column in columns)
        self._count_episodes(runs, scores, materials, each, self.epsilon)

    def _learn_whole(self, episode: WholeEpisode, randoms: Sequence[Generator], learning: Int64s) -> None:
        """Learn from an episode in the named runs (k,), step by step; all runs are shown it.

        ``randoms``, one for each run, select the batches.
        """
        steps, runs, batch = len(episode.actions), np.arange(len(randoms)), self.preset.update.batch
        draws = np.stack([random.random((steps, self.preset.updates_a_step * batch)) for random in randoms], axis=1)
        of_choices = np.stack([random.random(batch) for random in randoms])
        ended = np.arange(1, steps + 1) == steps

        def in_all(column: NDArray[Any]) -> NDArray[Any]:
            return np.repeat(column[:, None], len(runs), axis=1)

        states = in_all(self.agent.low_level_states(episode.observations, episode.materials))
        seen, materials, earned = map(in_all, (episode.observations, episode.materials, episode.earned))
        actions, rewards = in_all(episode.actions), in_all(episode.rewards)
        ends, terminates = in_all(ended), in_all(ended & episode.terminated)
        due, never, is_shown = in_all(episode.due), np.zeros(len(runs)), np.ones(len(runs), dtype=np.bool_)
        self._choices.begin(runs, never, np.ones((len(runs), CHOICE_NUMBERS)))
        self.practice.begin(runs, np.zeros((len(runs), self.practice.numbers)))
        for at, then in pairwise(range(steps + 1)):
            self.ticks += 1
            choice = ChoiceStep(seen[then], earned[at], ends[at], due[at], of_choices, self.ticks)
            self._choices.after(choice, materials[at], np.isin(runs, learning), never)
            done = actions[at], rewards[at], seen[then], materials[then], terminates[at], draws[at]
            self.practice.learn(Step(learning, is_shown, seen[at], materials[at], states[at], *done))
        self.practice.end(runs, materials[-1], earned[-1])
        self._choices.learn(learning, materials[-1], choice)

    def state(self) -> Arrays:
        """Return what the rest of the training depends on, without the journal."""
        runs = {"episodes": self.episodes_done, "evaluated_at": self._evaluated_at, "finished": self.runs_finished}
        return {
            "counts": np.array([self.ticks, self.env_steps, self.evaluation_steps]),
            **named_for("runs", {**runs, "demonstrated": self.demonstrated}),
            **named_for("agent", self.agent.state()),
            **named_for("policies", self.policies),
            **named_for("choices", self._choices.state()),
            **named_for("practice", self.practice.state()),
        }

    def marks(self) -> Arrays:
        """Return the length of the journal now: how many rows there are, and how many transitions."""
        rows = np.array([len(self.episode_rows), len(self.evaluation_rows)])
        return {"rows": rows, **named_for("agent", self.agent.marks())}

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """Return the rows and transitions since those marks; all of them if there are none."""
        episodes, evaluations = since["rows"] if since else (0, 0)
        transitions = self.agent.transitions_since(part_of(since, "agent") if since else None)
        return {
            "rows.episodes": table_of_rows(self.episode_rows[episodes:], EpisodeRow),
            "rows.evaluations": table_of_rows(self.evaluation_rows[evaluations:], EvaluationRow),
            **named_for("agent", transitions),
        }

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs."""
        self.ticks, self.env_steps, self.evaluation_steps = (int(count) for count in state["counts"])
        self.episodes_done[:] = state["runs.episodes"]
        self._evaluated_at[:] = state["runs.evaluated_at"]
        self.runs_finished[:] = state["runs.finished"]
        self.demonstrated[:] = state.get("runs.demonstrated", 0)  # none by a version before
        self.epsilon = self._epsilon_now()
        self.agent.load(part_of(state, "agent"))
        for name, array in self.policies.items():
            array[:] = state[f"policies.{name}"]
        self._choices.load(part_of(state, "choices"))
        self.practice.load(part_of(state, "practice"))
        for journal in journals:
            self.episode_rows += rows_of_table(journal["rows.episodes"], EpisodeRow)
            self.evaluation_rows += rows_of_table(journal["rows.evaluations"], EvaluationRow)
            self.agent.store_again(part_of(journal, "agent"))

    def _count_episodes(
        self, runs: Int64s, scores: Float64s, materials: Int64s, steps: Int64s, epsilons: Sequence[Float64s]
    ) -> None:
        """Count a training episode of the named runs (k,), played with these ε; every array is of all runs."""
        self.episodes_done[runs] += 1
        self.epsilon = self._epsilon_now()
        columns = self.episodes_done, scores, materials, steps, *epsilons
        self.episode_rows += map(EpisodeRow, runs.tolist(), *(column[runs].tolist() for column in columns))

    def _count_evaluation(self, row: EvaluationRow, online: Mapping[str, NDArray[Any]]) -> None:
        """Count a greedy evaluation of these networks: its run may keep them, and may be finished."""
        run = row.trial
        self.evaluation_rows.append(row)
        self._evaluated_at[run] = row.episode
        if self.preset.keep == "last" or row.score > self.policy_scores[run]:
            self.policy_scores[run] = row.score
            of_run = self.agent.rows_of(run)
            for role, networks in online.items():
                self.policies[role][of_run[role]] = networks[of_run[role]]
        reached = self._stop_at_optimum and row.score >= self._optimum[run]
        self.runs_finished[run] = row.episode >= self.preset.episodes or reached

    def _epsilon_now(self) -> tuple[Float64s, Float64s]:
        main, nested = self._decays
        done, episodes = self.episodes_done, self.preset.episodes
        return epsilon_after(done, episodes, main), epsilon_after(done, episodes, nested)


def practice_of(
    agent: Agent, scenarios: Sequence[Scenario], preset: Preset, seed: int, background: Background | None
) -> Practice:
    """Return the preset's practice, for the agent's runs; in the background, if there is one, where it can be."""
    if isinstance(agent, UnknownDesigns):
        return Tries(agent, preset)
    if preset.excursions:
        return Excursions(agent, preset, preset.excursions, scenarios)
    imagination = imagination_of(agent, scenarios, preset, seed)
    if imagination is None:
        return Practice(agent, preset)
    return LearntGame(agent, preset, imagination, scenarios, background)
