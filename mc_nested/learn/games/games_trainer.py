"""Training one run of an agent with many games, each of which plays whole episodes by itself.

A game that is free gets a plan: the networks as they are now. Its episode counts when it is back, whole and confirmed,
and exactly once. A game that dies costs its own episode alone, and nothing is learnt of that.

With an imagination all games' transitions make one learnt game. Each episode is planned to differ from those that are
out: the unknown cells where these should place blocks are taken to pay nothing, materials that they try first are not
tried again, and of the actions that nobody has tried yet each game begins with others. With a single game, whose
episode is taken before the next one is planned, the training is that of trainer.py in the simulator, to the bit.

Without one, a game plays with the networks of its plan, and the learner does the updates of an episode once it is back.
"""

import secrets
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.exploration.schedules import decays_of
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.games.episodes_out import EpisodeOut, EpisodesOut
from mc_nested.learn.games.fit import check_games
from mc_nested.learn.games.lesson import RUN, learn_episode, materials_of, record_episode
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.kept_policies import KeptPolicies
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.main_choices import MainChoices
from mc_nested.learn.preset import Preset
from mc_nested.learn.state_dict import named_for, part_of
from mc_nested.learn.streams import lesson_stream, plan_stream
from mc_nested.learn.training_journal import TrainingJournal

SITTINGS = 1 << 62
"""So many that no two of a training's processes draw the same name."""


class GamesTrainer:
    """Trains one run until it has its episodes. It is a Training (learn/training.py).

    Args:
        scenario: what is built.
        agent: what is trained, in one run.
        preset: the hyper-parameters; ``episodes`` as in the preset or as asked for.
        seed: of all random choices; the same seed, and the same order of episodes, give the same training.
        stop_at_optimum: finish at the first greedy evaluation at the scenario's optimum.

    Raises:
        PresetError: the preset explores, or the scenario is built, in a way that needs every step at once.
    """

    def __init__(
        self, scenario: Scenario, agent: Agent, preset: Preset, seed: int, stop_at_optimum: bool = False
    ) -> None:
        check_games(scenario, preset)
        self.agent = agent
        self.preset = preset
        self.env_steps = 0
        self.evaluation_steps = 0
        self._journal = TrainingJournal(agent)
        self.episode_rows, self.evaluation_rows = self._journal.episodes, self._journal.evaluations
        self._step_limit, self._optimum = scenario.step_limit, scenario.optimum
        self._stop_at_optimum = stop_at_optimum
        self._seed = seed
        start = agent.start_states([scenario])
        self._choices = MainChoices(agent.main, [scenario], start, preset, seed, agent.runs) if agent.main else None
        self._explore = decays_of(preset)
        self._imagination = agent.imagination([scenario], preset, seed)
        self._kept = KeptPolicies(agent)
        self._episodes = np.zeros(1, dtype=np.int64)
        self._evaluated_at = np.zeros(1, dtype=np.int64)
        self._finished = np.zeros(1, dtype=np.bool_)
        self._planned = 0
        self._sitting = secrets.randbelow(SITTINGS)
        self._out = EpisodesOut()

    @property
    def finished(self) -> bool:
        """Whether the run is finished."""
        return bool(self._finished[0])

    @property
    def episodes_done(self) -> Int64s:
        """Training episodes completed, (1,)."""
        return self._episodes

    @property
    def runs_finished(self) -> Bools:
        """Whether the run is finished, (1,)."""
        return self._finished

    @property
    def kept_scores(self) -> Float64s:
        """The greedy score of the policy that the run keeps, (1,); -inf before the first evaluation."""
        return self._kept.scores

    @property
    def kept(self) -> Arrays:
        """The networks of the policy that the run keeps, by role, and its ``scores``: what plays afterwards."""
        return {**self._kept.online, "scores": self._kept.scores}

    @property
    def epsilon(self) -> tuple[Float64s, Float64s]:
        """The main and the nested agent's ε of a training episode that is planned now, (1,) each."""
        main, nested = self._explore
        return main.epsilon(self._episodes, self.preset.episodes), nested.epsilon(self._episodes, self.preset.episodes)

    @property
    def imagination(self) -> Imagination | None:
        """What the run has learnt of its game; None if the preset has no [imagination]."""
        return self._imagination

    def begin_from(self, online: Mapping[str, NDArray[Any]], *, evaluated_first: bool = True) -> None:
        """Begin with another run's networks, by role; they are evaluated before the first episode if so wished."""
        self.agent.load_online(online)
        self._kept.take_all()
        self._evaluated_at[:] = -1 if evaluated_first else 0

    def plan(self, game: str) -> EpisodePlan:
        """The next episode of that game, which is free: what it had out before won't come.

        With an imagination it practises first, to the end. ValueError if the run is finished.
        """
        if self.finished:
            raise ValueError("the run is finished: there is nothing left to play")
        self._out.leave(game)
        random = plan_stream(self._seed, self.agent.runs[0], self._planned)
        greedy, is_begun_from = self._is_evaluation_due(), self._is_begun_from
        if self._imagination and not is_begun_from:
            self._imagination.learn_choice(0, self._out.materials)
        main, nested = (0.0 if greedy else float(epsilon[0]) for epsilon in self.epsilon)
        numbers = random.random((1, CHOICE_NUMBERS))
        material = int(self._choices.begin(RUN, np.array([main]), numbers)[0]) if self._choices else 0
        probes = frozenset[Cell]()
        if self._imagination:
            greedy = (self._practise(self._imagination, material) and greedy) or is_begun_from or self._is_last
            probes = self._imagination.probes(0, material)
            nested = float(self._is_one_of_the_first and not greedy)
        row = int(self.agent.low_level_rows(RUN, np.array([material]))[0])
        plan = EpisodePlan(
            number=self._planned,
            sitting=self._sitting,
            material=material,
            greedy=greedy,
            online=self.agent.low_level.engine.online[row].copy(),
            epsilon=nested,
            numbers=random.random((self._step_limit if nested else 0, CHOICE_NUMBERS)),
            first_tries=self._first_tries(greedy=greedy),
        )
        online = {role: kept.copy() for role, kept in self.agent.online().items()} if greedy else {}
        self._out.add(EpisodeOut(plan, game, int(self._episodes[0]), (main, nested), probes, online))
        self._planned += 1
        return plan

    def take(self, played: PlayedEpisode) -> bool:
        """Learn from a whole episode; whether it counted.

        It doesn't where its plan isn't out: it was taken or abandoned, comes from before the training was resumed, is
        an evaluation of an older policy than one that has counted, or the training has all its episodes. DivergedError
        as for a trainer's tick.
        """
        out = self._out.remove(played.number) if played.sitting == self._sitting else None
        if out is None:
            return False
        materials = materials_of(self.agent, played, out.plan.material)
        if self._imagination:
            record_episode(self._imagination, played, out.plan.material)
        if out.plan.greedy:
            self._end_evaluation(out, played, int(materials[-1]))
        else:
            self._learn(out, played, materials)
            self._end_training_episode(out, played, int(materials[-1]))
        return True

    def abandon(self, number: int) -> None:
        """The episode of that plan won't come: it is left out, and others may probe what it should have."""
        self._out.remove(number)

    def state(self) -> Arrays:
        """What the rest of the training depends on, without the journal. What is out isn't in it.

        A Trainer of one run can go on from it, and this from a Trainer's.
        """
        steps = self.env_steps, self.evaluation_steps
        runs = {"episodes": self._episodes, "evaluated_at": self._evaluated_at, "finished": self._finished}
        return {
            "counts": np.array([sum(steps), *steps]),
            "planned": np.array([self._planned]),
            **named_for("runs", runs),
            **named_for("agent", self.agent.state()),
            **named_for("kept", self.kept),
            **named_for("imagination", self._imagination.state() if self._imagination else {}),
        }

    def marks(self) -> Arrays:
        """The length of the journal now: how many rows there are, and how many transitions."""
        return self._journal.marks()

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """The rows and transitions since those marks; all of them if there are none."""
        return self._journal.since(since)

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs.

        What was out then was never played.
        """
        _, self.env_steps, self.evaluation_steps = (int(count) for count in state["counts"])
        self._episodes[:] = state["runs.episodes"]
        self._evaluated_at[:] = state["runs.evaluated_at"]
        self._finished[:] = state["runs.finished"]
        self.agent.load(part_of(state, "agent"))
        for name, kept in self.kept.items():
            kept[:] = state[f"kept.{name}"]
        if self._imagination:
            self._imagination.load(part_of(state, "imagination"))
        for journal in journals:
            self._journal.extend(journal)
        played = len(self.episode_rows) + len(self.evaluation_rows)
        self._planned = int(state["planned"][0]) if "planned" in state else played
        self._out.clear()

    def _practise(self, imagination: Imagination, material: int) -> bool:
        """Practise to the end, apart from what is out; whether the policy builds all of a known design."""
        elsewhere = self._out.probes if len(self._out) else None
        return imagination.practise(0, material, self._planned, elsewhere)

    def _first_tries(self, *, greedy: bool) -> FirstTries | None:
        if self._imagination is None or greedy:
            return None
        return self._imagination.first_tries(0).beside(len(self._out))

    @property
    def _is_one_of_the_first(self) -> bool:
        """Whether nothing at all is known yet, and another game plays already what a network says that knows nothing.

        That may stand still. By chance other cells are tried in each game, and an episode ends sooner.
        """
        return self._imagination is not None and not self._imagination.has_experience(0) and len(self._out) > 0

    @property
    def _is_begun_from(self) -> bool:
        """Whether a policy from elsewhere is still to be evaluated as it is."""
        return self._last_evaluation < 0

    @property
    def _last_evaluation(self) -> int:
        """The training episodes after which the last evaluation was planned, whether it is back or out."""
        return max(int(self._evaluated_at[0]), self._out.newest_evaluation)

    @property
    def _is_last(self) -> bool:
        """Whether all training episodes are done: every game gets the last evaluation; the first one back counts."""
        return bool(self._episodes[0] >= self.preset.episodes)

    def _is_evaluation_due(self) -> bool:
        """Whether it is time to evaluate: never twice after the same episodes, but for the last evaluation.

        One that doesn't come back, from a game that hangs, is followed by another a few episodes later.
        """
        every = 1 if self._imagination else self.preset.evaluate_every
        return self._is_last or int(self._episodes[0]) // every > self._last_evaluation // every

    def _learn(self, out: EpisodeOut, played: PlayedEpisode, materials: Int64s) -> None:
        """Update from a training episode; with an imagination, practice does."""
        if not self._imagination:
            random = lesson_stream(self._seed, self.agent.runs[0], out.plan.number)
            tick = self.env_steps + self.evaluation_steps + played.steps
            learn_episode(self.agent, self._choices, self.preset, played, materials, tick, random)

    def _end_evaluation(self, out: EpisodeOut, played: PlayedEpisode, material: int) -> None:
        self.evaluation_steps += played.steps
        self.evaluation_rows.append(EvaluationRow(0, out.episodes, played.score, material, played.steps))
        self._evaluated_at[0] = out.episodes
        self._out.supersede(out.episodes)
        if self.preset.keep == "last" or played.score > self._kept.scores[0]:
            self._kept.take(0, played.score, out.online)
        reached = self._stop_at_optimum and played.score >= self._optimum
        self._finished[0] = out.episodes >= self.preset.episodes or reached
        if self.finished:
            self._out.clear()

    def _end_training_episode(self, out: EpisodeOut, played: PlayedEpisode, material: int) -> None:
        self.env_steps += played.steps
        self._episodes[0] += 1
        told = int(self._episodes[0]), played.score, material, played.steps
        self.episode_rows.append(EpisodeRow(0, *told, *out.epsilons))
        if self._is_last:
            self._out.keep_evaluations()
