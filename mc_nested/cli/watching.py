"""An episode that a person watches: the arena as it is built, and a new start after a mishap."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from mc_nested.arena.env import ArenaEnv
from mc_nested.cli.viewing import Viewed
from mc_nested.errors import LiveError, NotInFrontError, StoppedError
from mc_nested.report.terminal import arena_view
from mc_nested.view.status import ArenaSeen, Standing

STEP_S = 0.25
"""Seconds of a simulated step in a view."""

TRIES = 3
"""Attempts at an episode: a mishap in the running game may end all but the last."""

Played = TypeVar("Played")


def arena_seen(env: ArenaEnv) -> ArenaSeen:
    """An Env's arena for the view."""
    stands = tuple(Standing(x, y, 1) for x, y in sorted(env.placed))
    return ArenaSeen.of(env.scenario).model_copy(update={"stands": stands, "agents": (Standing(*env.cell, 1),)})


@contextmanager
def watched(env: ArenaEnv, title: str, viewing: Viewed, *, quiet: bool = False) -> Iterator[Callable[[], None]]:
    """A function that shows the arena as it is now, in the place of what it showed before, while the block runs.

    It publishes the arena, too, and returns once nobody wants a pause any more. A view leaves no room for anything else
    here; in it, simulated steps are slowed down, so that they can be followed.
    """
    quiet = quiet or viewing.is_shown
    console = Console(quiet=quiet)
    with Live(console=console, auto_refresh=False) as live:

        def show() -> None:
            scenario = env.scenario
            viewing.publisher.board.show(arena=arena_seen(env))
            viewing.publisher.wait_while_paused()
            if viewing.is_shown and env.game.log is None:
                time.sleep(STEP_S)
            built = len(env.placed & scenario.design)
            line = Text(f"  {title}: {built} of {scenario.blocks} blocks on the design")
            live.update(Group(arena_view(scenario, env.cell, env.placed), line), refresh=True)

        yield show
    if not (quiet or console.is_terminal):
        console.print()  # rich leaves the last line unfinished then


def started_over(episode: Callable[[], Played]) -> Played:
    """What the episode returns; it starts over after a mishap, and the last try's LiveError is raised.

    What a person did on purpose is no mishap: StoppedError and NotInFrontError are raised at once.
    """
    for tries_left in reversed(range(TRIES)):
        try:
            return episode()
        except (StoppedError, NotInFrontError):  # noqa: PERF203 - each try may fail
            raise
        except LiveError as error:
            if not tries_left:
                raise
            typer.echo(f"  {error}; the episode starts over", err=True)
    raise AssertionError("the last try returned or raised")
