"""What a training shows of itself in its view: the arena of its trials, episodes, scores, what it has found out."""

import time
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Protocol

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.episode_log import EpisodeRow
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.training import Training
from mc_nested.report.game_time import expected
from mc_nested.report.terminal import belief_rows
from mc_nested.view.board import Board
from mc_nested.view.status import MOST_SCORES, ArenaSeen, Learning, Standing
from sim.worlds import Backend, where_words

SHOW_EVERY_S = 0.3

LOOK_EVERY_S = 2.0
"""Seconds between two looks at what was learnt: each replays what was seen."""


class Arenas(Protocol):
    """What a view sees of the arenas, by trial; where several builders share one, by trial and builder."""

    def cell(self, place: int) -> Cell: ...

    def placed(self, place: int) -> frozenset[Cell]: ...


class TrainingView:
    """Writes the state of a training to its board, no more often than a view shows it.

    Args:
        board: takes it.
        trainer: what is shown.
        scenario: what is built.
        arenas: where; one a trial.
        config: where it is played: in a running game minutes count, and its journal says what it does.
    """

    def __init__(
        self,
        board: Board,
        trainer: Training,
        scenario: Scenario,
        arenas: Arenas,
        config: RunConfig,
    ) -> None:
        self._board = board
        self._trainer = trainer
        self._scenario = scenario
        self._arenas = arenas
        self._trials = len(trainer.episodes_done)
        self._expected = (
            expected(config.preset, scenario, stop_at_optimum=config.stop_at_optimum)
            if config.backend == "live"
            else None
        )
        self._where = where_words(Backend(config.backend))
        self._curve = ScoreCurve()
        self._best = BestScores(self._trials)
        self._beliefs: tuple[str, ...] = ()
        self._exploring = ""
        self._next = self._next_look = 0.0
        self._began, self._steps_before = time.monotonic(), trainer.env_steps

    def show(self) -> None:
        """Write down how the training is, if it is time to."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + SHOW_EVERY_S
            self._set_down()

    def show_end(self) -> None:
        """Write down how the training ended."""
        self._next_look = 0.0
        self._set_down()

    def _set_down(self) -> None:
        self._look()
        self._board.show(arena=self._arena(), learning=self._learning())
        if self._expected is None:
            self._board.does(f"trains {self._where}")
            steps = self._trainer.env_steps - self._steps_before
            self._board.show(detail=f"{steps / max(time.monotonic() - self._began, 1e-9):,.0f} steps a second")

    def _arena(self) -> ArenaSeen:
        builders = self._trainer.agent.builders
        places = range(self._trials * builders)
        return ArenaSeen.of(
            self._scenario,
            stands=_counted(cell for first in places[::builders] for cell in self._arenas.placed(first)),
            agents=_counted(self._arenas.cell(place) for place in places),
            beliefs=self._beliefs,
        )

    def _learning(self) -> Learning:
        trainer = self._trainer
        last = trainer.episode_rows[-self._trials :]
        most = int(np.where(trainer.runs_finished, trainer.episodes_done, trainer.preset.episodes).sum())
        return Learning(
            trials=self._trials,
            episodes=int(trainer.episodes_done.sum()),
            episodes_at_most=most,
            score=float(np.mean([row.score for row in last])) if last else None,
            best=self._best.after(trainer),
            optimum=self._scenario.optimum,
            at_optimum=int((trainer.policy_scores >= self._scenario.optimum).sum()),
            scores=self._curve.after(trainer.episode_rows),
            exploring=self._exploring,
            game_minutes_left=self._minutes_left(),
        )

    def _minutes_left(self) -> float | None:
        if self._expected is None:
            return None
        played = len(self._trainer.episode_rows) + len(self._trainer.evaluation_rows)
        return self._expected.minutes * max(0.0, 1 - played / self._expected.episodes)

    def _look(self) -> None:
        """See what the first trial has found out of its game, now and then."""
        trainer, now = self._trainer, time.monotonic()
        if trainer.practice.known is None:
            main, nested = (float(epsilon.mean()) for epsilon in trainer.epsilon)
            self._exploring = f"ε {main:.2f}, {nested:.2f} (main agent, nested agent)"
        elif now >= self._next_look:
            self._next_look = now + LOOK_EVERY_S
            seen = trainer.practice.known.known_arena(0)
            doing = "probing" if seen.explores else "building"
            of_several = "trial 0: " if self._trials > 1 else ""
            self._exploring = f"{of_several}{doing}, {seen.known_to_pay} of {self._scenario.blocks} cells known"
            self._beliefs = belief_rows(seen) if self._trials == 1 else ()


class ScoreCurve:
    """The mean score of the trials, episode by episode, as at most MOST_SCORES points."""

    def __init__(self) -> None:
        self._sums: list[float] = []
        self._counts: list[int] = []
        self._rows = 0

    def after(self, rows: Sequence[EpisodeRow]) -> tuple[float, ...]:
        """Return the curve after those rows; they only ever become more."""
        for row in rows[self._rows :]:
            missing = row.episode - len(self._sums)
            self._sums += [0.0] * missing
            self._counts += [0] * missing
            self._sums[row.episode - 1] += row.score
            self._counts[row.episode - 1] += 1
        self._rows = len(rows)
        if not rows:
            return ()
        means = np.array(self._sums) / np.maximum(self._counts, 1)
        parts = np.array_split(means, min(MOST_SCORES, len(means)))
        return tuple(round(float(part.mean()), 2) for part in parts)


class BestScores:
    """The highest score that each trial had, in training and in evaluations, as a mean over the trials."""

    def __init__(self, trials: int) -> None:
        self._best = np.full(trials, -np.inf)
        self._episodes = self._evaluations = 0

    def after(self, trainer: Training) -> float | None:
        """Return the mean after what the trainer did until now; None until every trial had a score."""
        for episode in trainer.episode_rows[self._episodes :]:
            self._best[episode.trial] = max(self._best[episode.trial], episode.score)
        for evaluation in trainer.evaluation_rows[self._evaluations :]:
            self._best[evaluation.trial] = max(self._best[evaluation.trial], evaluation.score)
        self._episodes, self._evaluations = len(trainer.episode_rows), len(trainer.evaluation_rows)
        return float(self._best.mean()) if np.isfinite(self._best).all() else None


def _counted(cells: Iterable[Cell]) -> tuple[Standing, ...]:
    return tuple(Standing(x, y, count) for (x, y), count in sorted(Counter(cells).items()))
