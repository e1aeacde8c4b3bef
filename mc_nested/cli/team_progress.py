"""A team's training as it goes on: a bar in a terminal, a line now and then elsewhere."""

import contextlib
import time
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from mc_nested.cli.output import print_line
from mc_nested.cli.progress import LINE_EVERY_S, RECENT, REFRESH_S
from mc_nested.learn.cooperation.team_trainer import TeamTrainer


class TeamProgress:
    """Shows a team's trainer, no more often than an eye can follow.

    Args:
        optimum: the highest score.
        trainer: what is shown.
        console: where.
    """

    def __init__(self, optimum: float, trainer: TeamTrainer, console: Console) -> None:
        self._optimum = optimum
        self._trainer = trainer
        self._bar = Progress(
            TextColumn("{task.description}"), BarColumn(bar_width=None), MofNCompleteColumn(), TimeRemainingColumn(),
            console=console, expand=True,
        )  # fmt: skip
        self._task = self._bar.add_task("episodes", total=self._most)
        self._every = REFRESH_S if console.is_terminal else LINE_EVERY_S
        self._next = time.monotonic() + (0.0 if console.is_terminal else LINE_EVERY_S)

    def __enter__(self) -> "TeamProgress":
        if self._bar.console.is_terminal:
            self._bar.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if error is None:  # what failed is one line
            self._refresh()
        if self._bar.console.is_terminal:
            with contextlib.suppress(OSError):  # the terminal is closed
                self._bar.stop()

    def show(self) -> None:
        """Refresh the bar, or print a line, if it is time."""
        now = time.monotonic()
        if now >= self._next:
            self._next = now + self._every
            self._refresh()

    @property
    def _most(self) -> int:
        return len(self._trainer.episodes_done) * self._trainer.preset.episodes

    def _refresh(self) -> None:
        done, figures = int(self._trainer.episodes_done.sum()), self._figures()
        if not self._bar.console.is_terminal:
            print_line(self._bar.console, f"episodes {done:,} of {self._most:,}  {figures}")
            return
        with contextlib.suppress(OSError):  # the terminal is closed: the training goes on until it is saved
            self._bar.update(self._task, completed=done, description=figures)

    def _figures(self) -> str:
        recent = self._trainer.episode_rows[-RECENT * len(self._trainer.episodes_done) :]
        score = f"{sum(row.score for row in recent) / len(recent):5.1f}" if recent else "    -"
        main, nested = (float(epsilon.mean()) for epsilon in self._trainer.epsilon)
        return f"mean score {score} of {self._optimum:g}  ε {main:.2f} {nested:.2f}"
