"""--view: a run that is published while it goes on, and shown in this terminal if that is asked for."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.cli.terminal_view import TerminalView, can_draw
from mc_nested.view.board import Board
from mc_nested.view.publisher import Publisher

ViewOption = Annotated[
    bool,
    typer.Option("--view", help="show it in the terminal as it goes on: keys to pause, to go on, to stop"),
]

StepViewOption = Annotated[
    bool, typer.Option("--view", help="show it in the terminal as it goes on: keys to stop, and to answer")
]
"""Of what can't be paused."""


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
        """A person's yes or no, by the view; by ``otherwise`` where there is none, or it is closed meanwhile."""
        answer = self.publisher.answer(question, lambda: self.is_shown) if self.is_shown else None
        return otherwise(question) if answer is None else answer


@contextmanager
def viewed(is_viewed: bool, what: str, title: str, folder: Path | None = None) -> Iterator[Viewed]:
    """A run that can be viewed, for the block; where there is no terminal, it prints its lines as without a view.

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
