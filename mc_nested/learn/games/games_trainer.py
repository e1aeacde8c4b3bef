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

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Int64s, copied
from mc_nested.errors import PresetError
from mc_nested.learn.agents import Agent
from mc_nested.learn.episode_log import EvaluationRow
from mc_nested.learn.games.episode import EpisodeOut, EpisodePlan, EpisodesOut, PlayedEpisode
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Purpose, stream
from mc_nested.learn.training import Training
from mc_nested.learn.whole_episode import WholeEpisode

PROCESSES = 1 << 62
"""Names to draw from, so many that no two of a training's processes draw the same."""

RUN = np.zeros(1, dtype=np.int64)
"""The one run, as rows are named."""


def check_games(scenario: Scenario, preset: Preset) -> None:
    """Raise PresetError, one line, if games can't play that preset's episodes of that scenario by themselves."""
    if preset.excursions:  # each step of one depends on what the learner remembers of the best
        raise PresetError(
            "[excursions] need the learner at every step: with several games take the preset model-based or paper"
        )
    if scenario.parts:  # the main agent chooses within an episode
        raise PresetError(f"{scenario.name} has parts, which several games can't learn together: train with one game")


class GamesTrainer(Training):
    """Trains one run until it has its episodes; arguments as ``Training``'s, of one run.

    The same seed, and the same order of episodes, give the same training. Of its checkpoints a Trainer of one run can
    go on, and it of those.

    Raises:
        PresetError: the preset explores, or the scenario is built, in a way that needs every step at once.
    """

    def __init__(
        self, scenario: Scenario, agent: Agent, preset: Preset, seed: int, stop_at_optimum: bool = False
    ) -> None:
        check_games(scenario, preset)
        super().__init__([scenario], agent, preset, seed, stop_at_optimum)
        self._step_limit = scenario.step_limit
        self._planned = 0
        self._process = secrets.randbelow(PROCESSES)
        self._out = EpisodesOut()

    def plan(self, game: str) -> EpisodePlan:
        """Plan the next episode of that game, which is free: what it had out before won't come.

        With an imagination it practises first, to the end. ValueError if the run is finished.
        """
        if self.finished:
            raise ValueError("the run is finished: there is nothing left to play")
        self._out.leave(game)
        random = stream(Purpose.PLANS, self._seed, self.agent.runs[0], self._planned)
        is_begun_from = self._last_evaluation < 0  # a policy from elsewhere is still to be evaluated as it is
        is_due = self._is_evaluation_due()
        self.practice.before_choice(RUN[:0] if is_begun_from else RUN, self._out.materials)
        main, nested = (0.0 if is_due else float(epsilon[0]) for epsilon in self.epsilon)
        numbers = random.random((1, CHOICE_NUMBERS))
        material = int(self._choices.begin(RUN, np.array([main]), numbers)[0])
        elsewhere = self._out.probes if len(self._out) else None
        is_ready = self.practice.practise(0, material, self._planned, elsewhere)
        greedy = (is_ready and is_due) or is_begun_from or self._is_last
        if not greedy:
            nested = self.practice.epsilon_in_a_game(0, nested, len(self._out))
        row = int(self.agent.low_level_rows(RUN, np.array([material]))[0])
        plan = EpisodePlan(
            number=self._planned,
            process=self._process,
            material=material,
            greedy=greedy,
            online=self.agent.low_level.engine.online[row].copy(),
            epsilon=nested,
            numbers=random.random((self._step_limit if nested else 0, CHOICE_NUMBERS)),
            first_tries=None if greedy else self.practice.first_tries(0, len(self._out)),
        )
        online = copied(self.agent.online()) if greedy else {}
        probes = self.practice.probes(0, material)
        self._out.add(EpisodeOut(plan, game, int(self.episodes_done[0]), (main, nested), probes, online))
        self._planned += 1
        return plan

    def take(self, played: PlayedEpisode) -> bool:
        """Learn from a whole episode; whether it counted.

        It doesn't where its plan isn't out: it was taken or abandoned, comes from before the training was resumed, is
        an evaluation of an older policy than one that has counted, or the training has all its episodes. DivergedError
        as for a trainer's tick.
        """
        out = self._out.remove(played.number) if played.process == self._process else None
        if out is None:
            return False
        materials = materials_of(self.agent, played, out.plan.material)
        self._learn(out, played, materials)
        end = self._end_evaluation if out.plan.greedy else self._end_training_episode
        end(out, played, int(materials[-1]))
        return True

    def abandon(self, number: int) -> None:
        """Leave out the episode of that plan, which won't come; others may probe what it should have."""
        self._out.remove(number)

    def state(self) -> Arrays:
        """Return what the rest of the training depends on, without the journal. What is out isn't in it."""
        return {**super().state(), "planned": np.array([self._planned])}

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs.

        What was out then was never played.
        """
        super().load(state, journals)
        played = len(self.episode_rows) + len(self.evaluation_rows)
        self._planned = int(state["planned"][0]) if "planned" in state else played
        self._out.clear()

    @property
    def _last_evaluation(self) -> int:
        """The training episodes after which the last evaluation was planned, whether it is back or out."""
        return max(int(self._evaluated_at[0]), self._out.newest_evaluation)

    @property
    def _is_last(self) -> bool:
        """Whether all training episodes are done: every game gets the last evaluation; the first one back counts."""
        return bool(self.episodes_done[0] >= self.preset.episodes)

    def _is_evaluation_due(self) -> bool:
        """Return whether it is time to evaluate: never twice after the same episodes, but for the last evaluation.

        One that doesn't come back, from a game that hangs, is followed by another a few episodes later.
        """
        every = self.practice.evaluate_every
        return self._is_last or int(self.episodes_done[0]) // every > self._last_evaluation // every

    def _end_evaluation(self, out: EpisodeOut, played: PlayedEpisode, material: int) -> None:
        self.evaluation_steps += played.steps
        row = EvaluationRow(0, out.episodes, played.score, material, played.steps)
        self._out.supersede(out.episodes)
        self._count_evaluation(row, out.online)
        if self.finished:
            self._out.clear()

    def _end_training_episode(self, out: EpisodeOut, played: PlayedEpisode, material: int) -> None:
        self.env_steps += played.steps
        epsilons = [np.array([epsilon]) for epsilon in out.epsilons]
        counts = np.array([material]), np.array([played.steps])
        self._count_episodes(RUN, np.array([played.score]), *counts, epsilons)
        if self._is_last:
            self._out.keep_evaluations()

    def _learn(self, out: EpisodeOut, played: PlayedEpisode, materials: Int64s) -> None:
        """Learn from the episode as if it were played now, step by step; nothing is stored of an evaluation."""
        random = stream(Purpose.EPISODES, self._seed, self.agent.runs[0], out.plan.number)
        done = played.observations, materials, played.actions, played.rewards
        earned, never_due = np.full(played.steps, played.score), np.zeros(played.steps, dtype=np.bool_)
        episode = WholeEpisode(*done, earned, never_due, played.terminated)
        self._learn_whole(episode, [random], RUN[:0] if out.plan.greedy else RUN)


def materials_of(agent: Agent, played: PlayedEpisode, planned: int) -> Int64s:
    """Return the material that was chosen when each observation was made, (steps + 1,).

    It is -1 before there was a choice.
    """
    if agent.main:
        return np.full(played.steps + 1, planned)
    return agent.chosen_materials(played.observations)
