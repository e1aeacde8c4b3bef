"""A training's progress bar: episodes, score, ε (the main agent's, the nested agent's) and updates per second."""

import time
from types import TracebackType

import numpy as np
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Column

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.trainer import Trainer

REFRESH_S = 0.2
RECENT = 30
"""The score shown is the mean over this many episodes."""


class TrainingProgress:
    """Shows a trainer's progress, no more often than an eye can follow."""

    def __init__(self, scenario: Scenario, trainer: Trainer) -> None:
        self._scenario = scenario
        self._trainer = trainer
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=None),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TextColumn("{task.fields[figures]}"),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            expand=True,
        )
        trials = len(trainer.episodes_done)
        self._task = self._bar.add_task("episodes", total=trials * trainer.preset.episodes, figures="")
        self._began = time.monotonic()
        self._updates_before = trainer.agent.updates
        self._next = self._began

    def __enter__(self) -> "TrainingProgress":
        self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._refresh(time.monotonic())
        self._bar.stop()

    def show(self) -> None:
        """Refresh the bar if it is time."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + REFRESH_S
            self._refresh(now)

    def _refresh(self, now: float) -> None:
        trainer = self._trainer
        recent = trainer.episode_rows[-RECENT * len(trainer.episodes_done) :]
        score = f"{sum(row.score for row in recent) / len(recent):5.1f}" if recent else "    -"
        done = np.where(trainer.runs_finished, trainer.preset.episodes, trainer.episodes_done)
        main, nested = (float(epsilon.mean()) for epsilon in trainer.epsilon)
        rate = (trainer.agent.updates - self._updates_before) / max(now - self._began, 1e-9)
        figures = f"mean score {score} of {self._scenario.optimum:g}  ε {main:.2f} {nested:.2f}  {rate:,.0f} updates/s"
        self._bar.update(self._task, completed=int(done.sum()), figures=figures)
