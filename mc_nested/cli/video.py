"""The option ``--video``, and filming a game that is played."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.drawing import Picture
from mc_nested.arena.game import Game
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import FilmError
from mc_nested.live.devices import Display
from mc_nested.live.live_game import LiveGame
from mc_nested.live.vision.chat_region import blanked_share, without_chat
from mc_nested.live.vision.game_screen import seen_gui_scale
from mc_nested.report.arena_picture import ARENA_PX, SMALL_ARENA_PX
from mc_nested.report.film import is_gif, open_film
from mc_nested.report.filmed_game import FilmedGame, Window

VideoOption = Annotated[
    Path | None,
    typer.Option("--video", metavar="FILE", help="film the episode: the arena, and the game's window, as .mp4 or .gif"),
]

HALF = 0.5
"""A window of which more is blanked shows little."""


@contextmanager
def filmed(game: Game, display: Display | None, scenario: Scenario, video: Path | None) -> Iterator[Game]:
    """The game, filmed if there is a file for it; however the block ends, the film shows what was played until then.

    FilmError, one line, where it can't be written.
    """
    if video is None:
        yield game
        return
    window = _window_of(game, display) if display else None
    arena_px = SMALL_ARENA_PX if is_gif(video) else ARENA_PX
    try:
        with open_film(video) as film:
            yield FilmedGame(game, scenario, film, window, arena_px)
    except FilmError:
        raise
    except BaseException:
        typer.echo(f"  film of what was played: {video}" if film.is_whole else "  there is no film", err=True)
        raise


def _window_of(game: Game, display: Display) -> Window:
    """The window's pictures, the chat blanked: a film is there to be shown to others."""

    def seen_scale() -> int | None:
        return seen_gui_scale(game.connection.screen) if isinstance(game, LiveGame) else None

    share = blanked_share(display.size(), seen_scale())
    if share > HALF:
        typer.echo(
            f"  {share:.0%} of the window is where the chat may be, and stays grey in the film: "
            "a smaller GUI Scale, or a larger window, shows more",
            err=True,
        )

    def picture() -> Picture:
        return without_chat(display.grab(), seen_scale())[..., ::-1]

    return Window(picture, time.monotonic)
