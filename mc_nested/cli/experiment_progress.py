"""One view of all that trains: a bar over all episodes, and each group's recent greedy scores beside the optimum."""

import time
from types import TracebackType

from rich.console import Console, Group
from rich.live import Live
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Column, Table
from rich.text import Text

from mc_nested.cli.standing import Standing
from mc_nested.cli.unit_process import Ended, Report

REFRESH_S = 0.25
"""No more often than an eye can follow."""

LINE_EVERY_S = 30.0
"""How often there is a line where no terminal shows a bar."""

MOST_ROWS = 10
"""Groups that are shown at once."""


class ExperimentProgress:
    """Shows a standing on standard error.

    Args:
        what: is being done, in a word.
        standing: what is shown.
        console: where; standard error unless given.
    """

    def __init__(self, what: str, standing: Standing, console: Console | None = None) -> None:
        self._what = what
        self._standing = standing
        self._console = console or Console(stderr=True)
        self._bar = Progress(
            TextColumn(what),
            BarColumn(bar_width=None),
            TextColumn("{task.percentage:3.0f} %"),
            TextColumn("{task.fields[figures]}"),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            console=self._console,
            expand=True,
        )
        self._task = self._bar.add_task(what, total=standing.total, completed=standing.episodes, figures="")
        self._live = Live(console=self._console, auto_refresh=False, transient=True)
        self._began = time.monotonic()
        self._next = self._began

    def __enter__(self) -> "ExperimentProgress":
        if self._console.is_terminal:
            self._live.start()
        else:
            self._next += LINE_EVERY_S
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self._console.is_terminal:
            self._live.stop()

    def watch(self, heard: Report | Ended | None) -> None:
        """Take in what a process says, and bring the view up to date if it is time to."""
        if heard is not None:
            self._standing.hear(heard)
        now = time.monotonic()
        if now < self._next:
            return
        if self._console.is_terminal:
            self._next = now + REFRESH_S
            self._bar.update(self._task, completed=self._standing.episodes, figures=self._rate())
            self._live.update(Group(self._bar, self._table()), refresh=True)
        else:
            self._next = now + LINE_EVERY_S
            self._console.print(self._line(now), markup=False, highlight=False, soft_wrap=True)

    def _rate(self) -> str:
        return f"{self._standing.updates / max(time.monotonic() - self._began, 1e-9):,.0f} updates/s"

    def _line(self, now: float) -> str:
        standing = self._standing
        done = standing.episodes - standing.episodes_before
        left = f"{(now - self._began) / done * (standing.total - standing.episodes) / 60:.1f} min left" if done else ""
        share = 100 * standing.episodes / standing.total
        return f"{self._what}: {share:.0f} % of {standing.total:,} episodes  {self._rate()}  {left}".rstrip()

    def _table(self) -> Table:
        standing = self._standing
        heads = [Text(f"{name} of {optimum:g}") for name, optimum in standing.optimum.items()]
        table = Table("recent score", *(Column(head, justify="right") for head in heads), box=None, padding=(0, 2))
        for group in standing.groups[-MOST_ROWS:]:
            scores = [standing.score(group, scenario) for scenario in standing.optimum]
            table.add_row(Text(group), *("" if score is None else f"{score:.1f}" for score in scores))
        return table
