"""``mc-nested view``: a run of this computer in a terminal, while it goes on and afterwards."""

import signal
import time
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.cli.runs_folder import RUNS
from mc_nested.cli.terminal_view import can_draw
from mc_nested.view.panels import plain_end, plain_line
from mc_nested.view.status_files import FOLDER, is_published, status_now
from mc_nested.view.words import StatusShown, life_of

LOOK_EVERY_S = 0.5


def view(
    run: Annotated[
        Path, typer.Argument(metavar="RUN", help="the folder of a training (its --out), or its name in runs/")
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
