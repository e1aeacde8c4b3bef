"""What a person asks of a run through a view: pause, stop, the answer to a question. Each is a file of its own.

So no request can overwrite another, whatever several views ask at once. A pause lasts while somebody looks: a view that
wants it renews its file, and one that nobody renews is over.
"""

import contextlib
import time
from collections.abc import Callable
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from mc_nested.atomic_file import atomic_write
from mc_nested.learn.runs.folder_kind import VIEW

PAUSE, STOP, ANSWER = "pause.request", "stop.request", "answer.request"

RENEWED_S = 5.0
"""Seconds after which a pause that nobody renewed is over: a view renews it three times a second."""


TRIES, AGAIN_S = 20, 0.03
"""An answer is written again, so many seconds later, where it can't be replaced."""


class YesOrNo(BaseModel):
    """Yes or no to the question of that number alone."""

    model_config = ConfigDict(frozen=True)

    number: int
    is_yes: bool


def ask_pause(folder: Path) -> None:
    """Ask the run in a folder to pause. Raise OSError if nothing can be written there."""
    (folder / VIEW / PAUSE).touch()


def renew_pause(folder: Path) -> bool:
    """Say that somebody still wants the pause; False where somebody asked to go on meanwhile."""
    path = folder / VIEW / PAUSE
    if not path.exists():
        return False
    with contextlib.suppress(OSError):
        path.touch()
    return True


def ask_to_go_on(folder: Path) -> None:
    """Ask the run to go on. Raise OSError if the file can't be removed."""
    (folder / VIEW / PAUSE).unlink(missing_ok=True)


def ask_to_stop(folder: Path) -> None:
    """Ask the run to stop: that can't be taken back. Raise OSError if nothing can be written there."""
    (folder / VIEW / STOP).touch()


def give_answer(folder: Path, answer: YesOrNo) -> None:
    """Answer the run's question. Raise OSError if nothing can be written there."""
    for tries_left in reversed(range(TRIES)):
        try:
            with atomic_write(folder / VIEW / ANSWER) as path:
                path.write_text(answer.model_dump_json(), encoding="utf-8")
            return
        except PermissionError:  # noqa: PERF203 - Windows, while the run reads it
            if not tries_left:
                raise
            time.sleep(AGAIN_S)


class Requests:
    """What is asked of the run in a folder; at first, nothing: what was asked of an earlier run is forgotten."""

    def __init__(self, folder: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder = folder / VIEW
        self._clock = clock
        self._renewed: tuple[int, float] | None = None
        for name in (PAUSE, STOP, ANSWER):
            with contextlib.suppress(OSError):
                (self._folder / name).unlink(missing_ok=True)

    def is_pause_asked(self) -> bool:
        """Return whether somebody wants a pause now."""
        try:
            at = (self._folder / PAUSE).stat().st_mtime_ns
        except OSError:
            self._renewed = None
            return False
        if self._renewed is None or self._renewed[0] != at:
            self._renewed = at, self._clock()
        return self._clock() - self._renewed[1] < RENEWED_S

    def is_stop_asked(self) -> bool:
        """Return whether somebody asked to stop."""
        return (self._folder / STOP).exists()

    def answer_to(self, number: int) -> bool | None:
        """Return the answer to that question; None where there is none yet."""
        try:
            answer = YesOrNo.model_validate_json((self._folder / ANSWER).read_bytes())
        except (OSError, ValidationError):
            return None
        return answer.is_yes if answer.number == number else None
