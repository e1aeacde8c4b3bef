"""A film as a file, .mp4 or .gif: pictures, each for some seconds. The file is there once it is whole, never before.

An episode is filmed as it is played: a picture after its reset, and one after each action.
"""

import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import Picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import FilmError
from mc_nested.report.arena_picture import ARENA_PX, Size, beside, box_for, draw_moment
from mc_nested.report.film_file import GifEncoder, Mp4Encoder, check_ffmpeg

FPS = 10
"""Pictures a second in the file."""

LAST_S = 2.0
"""Seconds for which the last picture is shown."""

ROOM = 10_000_000
"""Bytes that have to be free for a film: ten times what an episode's takes."""


Encoder = GifEncoder | Mp4Encoder
"""Writes one film, of pictures of one size, each shown for 1 / FPS seconds. OSError or FilmError where it can't."""

ENCODERS: dict[str, Callable[[Path, int], Encoder]] = {".mp4": Mp4Encoder, ".gif": GifEncoder}


class Film:
    """Pictures with the times at which they begin to be shown, in seconds. FilmError, one line, if it can't be written.

    Args:
        path: the film, for messages.
        new_encoder: writes the file, or writes it anew.
    """

    def __init__(self, path: Path, new_encoder: Callable[[], Encoder]) -> None:
        self._path, self._new_encoder = path, new_encoder
        self._encoder = new_encoder()
        self._shown: tuple[Picture, float] | None = None
        self._written = 0
        self.is_whole = False

    @property
    def is_empty(self) -> bool:
        """Whether no picture was shown yet."""
        return self._shown is None

    def begin_anew(self) -> None:
        """Forget all pictures."""
        self.stop()
        self._encoder, self._shown, self._written = self._new_encoder(), None, 0

    def show(self, picture: Picture, at: float) -> None:
        """Show a picture from that time on; the first one's is 0."""
        with _one_line(self._path):
            self._write_until(at)
        self._shown = picture, at

    def finish(self) -> None:
        """Show the last picture for LAST_S, and end the film."""
        with _one_line(self._path):
            if self._shown:
                self._write_until(self._shown[1] + LAST_S)
            self._encoder.finish()
        self.is_whole = True

    def stop(self) -> None:
        """Write no more."""
        self._encoder.stop()

    def _write_until(self, at: float) -> None:
        count = round(at * FPS) - self._written
        if self._shown and count > 0:
            self._encoder.add(self._shown[0], count)
            self._written += count


def check_film(path: Path) -> None:
    """Raise FilmError, one line, if no film can be written there: asked before anything is played."""
    if path.suffix.lower() not in ENCODERS:
        raise FilmError(f"{path}: a film is a file .mp4 or .gif: name one of these")
    if not path.parent.is_dir():
        raise FilmError(f"{path.parent} is no folder: name a film in a folder that exists")
    if path.is_dir():
        raise FilmError(f"{path} is a folder: name another film")
    if path.suffix.lower() == ".mp4":
        check_ffmpeg()
    if shutil.disk_usage(path.parent).free < ROOM:
        raise FilmError(f"{path}: less than {ROOM // 1_000_000} MB are free there: make room, or name another folder")
    with _one_line(path), tempfile.TemporaryFile(dir=path.parent):
        pass


@contextmanager
def open_film(path: Path) -> Iterator[Film]:
    """Open a film to show pictures in. Whatever ends the block, what was shown until then is a whole film.

    Where nothing was shown there is none. Raises FilmError, one line, where it can't be written. An earlier file of
    that name is kept until the new film is whole.
    """
    check_film(path)
    ended: BaseException | None = None
    with suppress(_NothingShownError), _one_line(path), atomic_write(path) as unfinished:
        film = Film(path, lambda: ENCODERS[path.suffix.lower()](unfinished, FPS))
        try:
            try:
                yield film
            except FilmError:
                raise
            except BaseException as error:
                ended = error
            if film.is_empty:
                raise _NothingShownError
            film.finish()
        finally:
            film.stop()
    if ended:
        raise ended


class _NothingShownError(Exception):
    """Ends the writing of a film that shows nothing."""


def _one_line(path: Path) -> AbstractContextManager[None]:
    return refused_as(FilmError, path, "make room, or name another folder")


FIRST_S, STEP_S = 1.0, 0.5
"""Seconds for which a game without a clock of its own is shown before its first action, and after each."""


@dataclass(frozen=True)
class Window:
    """A running game's window.

    Args:
        picture: what it shows now, the chat blanked.
        now: the time in seconds, from an arbitrary zero; the film runs as fast as that.
    """

    picture: Callable[[], Picture]
    now: Callable[[], float]


class EpisodeFilm:
    """What an Env plays, in a film: a picture each time that it is shown. An episode that begins begins the film anew.

    Args:
        film: where the pictures go.
        window: the game's window, if it has one, shown beside the arena.
        arena_px: how large the arena is drawn.
    """

    def __init__(self, film: Film, window: Window | None = None, arena_px: int = ARENA_PX) -> None:
        self._film, self._window, self._arena_px = film, window, arena_px
        self._began = 0.0
        self._box: Size | None = None

    def show(self, env: ArenaEnv, objective: Cell | None) -> None:
        """Show the arena as it is now, and frame the cell that the agent is after, if it has one."""
        simulated_s = FIRST_S + (env.steps - 1) * STEP_S if env.steps else 0.0
        now = self._window.now() if self._window else simulated_s
        if not env.steps:
            self._film.begin_anew()
            self._began, self._box = now, None
        picture = draw_moment(env, objective, self._arena_px)
        if self._window:
            window = self._window.picture()
            self._box = self._box or box_for(window, self._arena_px)
            picture = beside(picture, window, self._box)
        self._film.show(picture, now - self._began)
