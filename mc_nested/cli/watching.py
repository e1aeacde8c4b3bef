"""An episode that a person watches: the arena as it is built, and a film of it."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console, Group
from rich.live import Live
from rich.text import Text

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import Picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game
from mc_nested.cli.output import say_aside
from mc_nested.cli.view import Viewed
from mc_nested.errors import FilmError
from mc_nested.live.devices import Display
from mc_nested.live.live_game import LiveGame
from mc_nested.live.vision.chat_region import blanked_share, without_chat
from mc_nested.live.vision.game_screen import seen_gui_scale
from mc_nested.report.arena_picture import ARENA_PX, SMALL_ARENA_PX
from mc_nested.report.film import EpisodeFilm, Window, open_film
from mc_nested.report.terminal import arena_view
from mc_nested.view.status import ArenaSeen, Standing

VideoOption = Annotated[
    Path | None,
    typer.Option("--video", metavar="FILE", help="film the episode: the arena, and the game's window, as .mp4 or .gif"),
]

HALF = 0.5
"""A window of which more is blanked shows little."""

STEP_S = 0.25
"""Seconds of a simulated step in a view."""


def arena_seen(env: ArenaEnv, objective: Cell | None) -> ArenaSeen:
    """Return an Env's arena for the view, and the cell that the agent is after in it, if it has one."""
    stands = tuple(Standing(x, y, 1) for x, y in sorted(env.placed))
    return ArenaSeen.of(env.scenario, stands=stands, agents=(Standing(*env.cell, 1),), objective=objective)


@contextmanager
def watched(
    env: ArenaEnv, title: str, viewing: Viewed, film: EpisodeFilm | None, *, quiet: bool = False
) -> Iterator[Callable[[Cell | None], None]]:
    """Yield a function that shows the arena as it is now, in the place of what it showed before, while the block runs.

    It takes the cell that the agent is after from now on, if it has one. It films and publishes the arena, and returns
    once no pause is wanted. A view leaves no room for anything else here; in it, simulated steps are slowed down, so
    that they can be followed.
    """
    quiet = quiet or viewing.is_shown
    console = Console(quiet=quiet)
    with Live(console=console, auto_refresh=False) as live:

        def show(objective: Cell | None) -> None:
            scenario = env.scenario
            if film:
                film.show(env, objective)
            viewing.publisher.board.show(arena=arena_seen(env, objective))
            viewing.publisher.wait_while_paused()
            if viewing.is_shown and env.game.log is None:
                time.sleep(STEP_S)
            built = len(env.placed & scenario.design)
            line = Text(f"  {title}: {built} of {scenario.blocks} blocks on the design")
            live.update(Group(arena_view(scenario, env.cell, env.placed, objective), line), refresh=True)

        yield show
    if not (quiet or console.is_terminal):
        console.print()  # rich leaves the last line unfinished then


def times_of(game: Game) -> list[str]:
    """Return a line that says how long its actions took, and where that time went; none for the simulator."""
    taken = game.log.summary() if game.log else {}
    median = taken.get("action_s", {}).get("p50")
    return [] if median is None else [f"  {median:.3f} s an action (median); {taken['share']}"]


@contextmanager
def filmed(game: Game, display: Display | None, video: Path | None) -> Iterator[EpisodeFilm | None]:
    """Yield a film of what is played, to show episodes in; None if there is no file for it.

    However the block ends, the film shows what was played until then.

    Raise FilmError, one line, where it can't be written.
    """
    if video is None:
        yield None
        return
    window = _window_of(game, display) if display else None
    # A .gif takes ten times an .mp4's room.
    arena_px = SMALL_ARENA_PX if video.suffix.lower() == ".gif" else ARENA_PX
    try:
        with open_film(video) as film:
            yield EpisodeFilm(film, window, arena_px)
    except FilmError:
        raise
    except BaseException:
        say_aside(f"film of what was played: {video}" if film.is_whole else "there is no film")
        raise


def _window_of(game: Game, display: Display) -> Window:
    """Return the window's pictures, the chat blanked: a film is there to be shown to others."""

    def seen_scale() -> int | None:
        return seen_gui_scale(game.connection.screen) if isinstance(game, LiveGame) else None

    share = blanked_share(display.size(), seen_scale())
    if share > HALF:
        say_aside(
            f"{share:.0%} of the window is where the chat may be, and stays grey in the film: "
            "a smaller GUI Scale, or a larger window, shows more"
        )

    def picture() -> Picture:
        return without_chat(display.grab(), seen_scale())[..., ::-1]

    return Window(picture, time.monotonic)
