"""A training's progress: a bar with episodes, score, ε (the main agent's, the nested agent's) and updates per second.

With an imagination, instead of ε, what it has found out; and in a terminal, for a single trial, its map of the arena.
"""

import time
from types import TracebackType

import numpy as np
from rich.console import Console, Group, RenderableType
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Column

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.trainer import Trainer
from mc_nested.report.terminal_map import map_view

REFRESH_S = 0.2
RECENT = 30
"""The score shown is the mean over this many episodes."""

LOOK_S = 1.0
"""Seconds between two looks at what was learnt within an episode: each replays what was seen."""

LINES_BESIDE = 4
"""Lines of a terminal that the map leaves free: the bar, the legend, and the line of the cursor."""


class _BarAndMap(Progress):
    """A progress bar with something below it."""

    below: RenderableType | None = None

    def get_renderable(self) -> RenderableType:
        """The bar, and what is below it."""
        bar = super().get_renderable()
        return bar if self.below is None else Group(bar, self.below)


class TrainingProgress:
    """Shows a trainer's progress, no more often than an eye can follow.

    Args:
        scenario: what is built.
        trainer: what is shown.
        console: where; standard output if there is none.
    """

    def __init__(self, scenario: Scenario, trainer: Trainer, console: Console | None = None) -> None:
        self._scenario = scenario
        self._trainer = trainer
        self._bar = _BarAndMap(
            TextColumn("{task.description}"),
            BarColumn(bar_width=None),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TextColumn("{task.fields[figures]}"),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            console=console,
            expand=True,
        )
        self._found_out = ""
        self._looked_at, self._look_again = -1, 0.0
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
        if trainer.imagination:
            self._look_at(trainer.imagination, now)
            exploring = self._found_out
        else:
            main, nested = (float(epsilon.mean()) for epsilon in trainer.epsilon)
            exploring = f"ε {main:.2f} {nested:.2f}"
        rate = (trainer.agent.updates - self._updates_before) / max(now - self._began, 1e-9)
        figures = f"mean score {score} of {self._scenario.optimum:g}  {exploring}  {rate:,.0f} updates/s"
        self._bar.update(self._task, completed=int(done.sum()), figures=figures)

    def _look_at(self, imagination: Imagination, now: float) -> None:
        """See what the first trial has found out, in a new episode at once."""
        episodes = imagination.episodes(0)
        if episodes == self._looked_at and now < self._look_again:
            return
        self._looked_at, self._look_again = episodes, now + LOOK_S
        seen = imagination.seen(0)
        of_several = "trial 0: " if len(self._trainer.episodes_done) > 1 else ""
        doing = "probing" if seen.explores else "building"
        self._found_out = (
            f"{of_several}{episodes} played, {doing}, {seen.known_to_pay} of {self._scenario.blocks} cells known"
        )
        console = self._bar.console
        if console.is_terminal and not of_several and console.height >= len(seen.cells) + LINES_BESIDE:
            self._bar.below = map_view(seen)
