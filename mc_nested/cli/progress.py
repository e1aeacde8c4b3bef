"""A training's progress: a bar with episodes, score, ε (the main agent's, the nested agent's) and updates per second.

With an imagination, instead of ε, what it has found out; and in a terminal, for a single trial, its map of the arena.
Where there is no terminal, a line of text now and then.
"""

import contextlib
import time
from collections.abc import Callable

import numpy as np
from rich.console import Console, Group, RenderableType
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Column
from rich.text import Text

from mc_nested.arena.scenario import Scenario
from mc_nested.cli.output import print_line
from mc_nested.learn.imagination.known_arena import Knowing
from mc_nested.learn.training import Training
from mc_nested.report.terminal import map_view

REFRESH_S = 0.2
LINE_EVERY_S = 30.0
"""Seconds between two lines of text, if there is no terminal to show a bar."""

STOPPING = "stopping: what is under way ends, then it is saved; Ctrl+C again, after a second, stops at once, unsaved"
"""A practice that is under way can take half a minute."""

RECENT = 30
"""The score shown is the mean over this many episodes."""

LOOK_S = 1.0
"""Seconds between two looks at what was learnt within an episode: each replays what was seen."""

LINES_BESIDE = 8
"""Lines of a terminal that the map leaves free: bar, figures (2), legend (2), whether it stops (2), the cursor's."""


class _BarAndMap(Progress):
    """A progress bar with figures and a map below it. Rich draws it several times a second, even while a tick lasts."""

    figures: str = ""
    map: RenderableType | None = None
    stops: Callable[[], bool] = staticmethod(lambda: False)

    def get_renderable(self) -> RenderableType:
        """Return the bar, what is below it, and whether it is stopping."""
        below = [] if self.map is None else [self.map]
        return Group(super().get_renderable(), Text(self.figures), *below, *([Text(STOPPING)] if self.stops() else []))


class TrainingProgress:
    """Shows a trainer's progress, no more often than an eye can follow.

    Args:
        scenario: what is built.
        trainer: what is shown.
        console: where; standard error if there is none.
        stops: whether somebody asked to stop.
        players: says which games play, where there are several; otherwise empty.
    """

    def __init__(
        self,
        scenario: Scenario,
        trainer: Training,
        console: Console | None = None,
        stops: Callable[[], bool] = lambda: False,
        players: Callable[[], str] = str,
    ) -> None:
        self._players = players
        self._scenario = scenario
        self._trainer = trainer
        self._bar = _BarAndMap(
            TextColumn("{task.description}"),
            BarColumn(bar_width=None),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            console=console or Console(stderr=True),
            expand=True,
        )
        self._bar.stops = stops
        self.in_terminal = self._bar.console.is_terminal
        """Whether it is shown in a terminal, which says that it is stopping, too."""
        self._found_out = ""
        self._looked_at, self._look_again = -1, 0.0
        self._task = self._bar.add_task("episodes", total=len(trainer.episodes_done) * trainer.preset.episodes)
        self._began = time.monotonic()
        self._updates_before = trainer.agent.updates
        self._next = self._began

    def __enter__(self) -> "TrainingProgress":
        if self.in_terminal:
            self._bar.start()
        else:
            self._next += LINE_EVERY_S
        return self

    def __exit__(self, _: object, error: BaseException | None, *__: object) -> None:
        self._look_again = 0.0
        if self.in_terminal or error is None:  # what failed is one line
            self._refresh(time.monotonic())
        if self.in_terminal:
            with contextlib.suppress(OSError):  # the terminal is closed
                self._bar.stop()

    def say(self, line: str) -> None:
        """Print a line above the bar."""
        if self.in_terminal:
            self._bar.console.print(Text(line))
        else:
            print_line(self._bar.console, line)

    def show(self) -> None:
        """Refresh the bar, or print a line, if it is time."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + (REFRESH_S if self.in_terminal else LINE_EVERY_S)
            self._refresh(now)

    def _refresh(self, now: float) -> None:
        trainer = self._trainer
        recent = trainer.episode_rows[-RECENT * len(trainer.episodes_done) :]
        score = f"{sum(row.score for row in recent) / len(recent):5.1f}" if recent else "    -"
        done = int(trainer.episodes_done.sum())
        most = int(np.where(trainer.runs_finished, trainer.episodes_done, trainer.preset.episodes).sum())
        if trainer.practice.known:
            self._look_at(trainer.practice.known, now)
            exploring = self._found_out
        else:
            main, nested = (float(epsilon.mean()) for epsilon in trainer.epsilon)
            exploring = f"ε {main:.2f} {nested:.2f}"
        rate = (trainer.agent.updates - self._updates_before) / max(now - self._began, 1e-9)
        figures = f"mean score {score} of {self._scenario.optimum:g}  {exploring}  {rate:,.0f} updates/s"
        if said := self._players():
            figures += f"  {said}"
        self._bar.figures = figures
        with contextlib.suppress(OSError):  # the terminal is closed: the training goes on until it is saved
            self._bar.update(self._task, completed=done, total=most)
        if not self.in_terminal:
            print_line(self._bar.console, f"episodes {done:,} of at most {most:,}  {figures}")

    def _look_at(self, known: Knowing, now: float) -> None:
        """See what the first trial has found out, in a new episode at once."""
        episodes = known.episodes(0)
        if episodes == self._looked_at and now < self._look_again:
            return
        self._looked_at, self._look_again = episodes, now + LOOK_S
        seen = known.known_arena(0)
        of_several = "trial 0: " if len(self._trainer.episodes_done) > 1 else ""
        doing = "probing" if seen.explores else "building"
        self._found_out = (
            f"{of_several}{episodes} played, {doing}, {seen.known_to_pay} of {self._scenario.blocks} cells known"
        )
        console = self._bar.console
        if console.is_terminal and not of_several and console.height >= len(seen.cells) + LINES_BESIDE:
            self._bar.map = map_view(seen)
