"""``mc-nested view``, and --view: publish a run while it goes on, and show it in a terminal.

A finished run is shown the same way. Where there is no terminal to draw in, what it does is printed as lines.
"""

import signal
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.cli.completion import RUNS, complete_runs
from mc_nested.view.board import Board
from mc_nested.view.files import FOLDER, is_published, status_now
from mc_nested.view.panels import plain_end, plain_line
from mc_nested.view.publisher import Publisher
from mc_nested.view.terminal_view import TerminalView, can_draw
from mc_nested.view.words import StatusShown, life_of

ViewOption = Annotated[
    bool,
    typer.Option("--view", help="show it in the terminal as it goes on: keys to pause, to go on, to stop"),
]

StepViewOption = Annotated[
    bool, typer.Option("--view", help="show it in the terminal as it goes on: keys to stop, and to answer")
]
"""Of what can't be paused."""

LOOK_EVERY_S = 0.5


def view(
    run: Annotated[
        Path,
        typer.Argument(
            metavar="RUN",
            help="the folder of a training (its --out), or its name in runs/",
            autocompletion=complete_runs,
        ),
    ],
    close_at_end: Annotated[
        bool, typer.Option("--close-at-end", help="close by itself once the run has ended")
    ] = False,
) -> None:
    """Watch a training on this computer as it goes on, or one that has ended, moment by moment."""
    folder = run if (run / FOLDER).is_dir() or not (RUNS / run / FOLDER).is_dir() else RUNS / run
    status_now(folder)
    if not can_draw():
        _follow(folder)
        return
    from mc_nested.view.app import ViewApp  # it takes half a second to load

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is a key here; a signal is for the run in the same terminal
    ViewApp(folder, closes_at_end=close_at_end).run()


def _follow(folder: Path) -> None:
    """Print what the run does, whenever it begins something else, until it has ended."""
    said = ""
    while True:
        status = status_now(folder)
        life = life_of(status, is_published(folder), time.time())
        shown = StatusShown(status, time.time(), life)
        if (status.doing + life) != said:
            said = status.doing + life
            typer.echo(plain_line(shown))
        if life != "runs":
            for line in plain_end(shown):
                typer.echo(line)
            return
        time.sleep(LOOK_EVERY_S)


@dataclass(frozen=True)
class Viewed:
    """A run with its publisher, and the view in this terminal, if it has one."""

    publisher: Publisher
    view: TerminalView | None = None

    @property
    def is_shown(self) -> bool:
        """Whether it is shown in this terminal, which has no room for anything else then."""
        return self.view is not None and self.view.is_open

    def ask(self, question: str, otherwise: Callable[[str], bool]) -> bool:
        """Ask a person for a yes or no, in the view.

        Ask by ``otherwise`` where there is no view, or it is closed meanwhile.
        """
        answer = self.publisher.answer(question, lambda: self.is_shown) if self.is_shown else None
        return otherwise(question) if answer is None else answer


@contextmanager
def viewed(is_viewed: bool, what: str, title: str, folder: Path | None = None) -> Iterator[Viewed]:
    """Yield a run that can be viewed, for the block; where there is no terminal, it prints its lines as without a view.

    Args:
        is_viewed: whether it is shown in this terminal.
        what: its verb.
        title: what it does, in a line.
        folder: the run's folder, where ``mc-nested view`` finds it; without one it is published for this view alone.
    """
    board = Board(what, title)
    is_shown = is_viewed and can_draw()
    with ExitStack() as left:
        if folder is None:
            if not is_shown:
                yield Viewed(Publisher(board, Path()))  # never entered: it publishes nothing
                return
            folder = Path(left.enter_context(tempfile.TemporaryDirectory(prefix="mc-nested-view-")))
        if not is_shown:
            yield Viewed(left.enter_context(Publisher(board, folder)))
            return
        view = TerminalView(folder)
        left.callback(view.close)
        publisher = left.enter_context(Publisher(board, folder, view.lines))
        try:
            view.open()
        except (OSError, RuntimeError) as error:
            typer.echo(f"no view, the run goes on without it: {error}", err=True)
        yield Viewed(publisher, view)
