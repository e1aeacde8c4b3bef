"""What a run and its views write for each other, in the folder ``view`` of the run.

A run's status: now.json is its status now, history.jsonl its earlier ones, coarser the longer it lasts. A reader sees
either the old status or the new one, never a half. A scrubber is at one moment of the history.

What a person asks of a run through a view: pause, stop, taking over, the answer to a question. Each is a file of its
own, so no request can overwrite another, whatever several views ask at once. A pause lasts while somebody looks: a view
that wants it renews its file, and one that nobody renews is over.
"""

import contextlib
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError
from rich.text import Text

from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_kind import VIEW, VIEW_FILES
from mc_nested.learn.runs.folder_lock import holder_of
from mc_nested.view.status import Status
from mc_nested.view.words import clock_time

FOLDER = VIEW
NOW, HISTORY = "now.json", "history.jsonl"

MOST_KEPT = 600
"""Statuses in a history: with more, every second one is dropped, and from then on fewer are kept."""

KEEP_EVERY_S = 0.3
"""Seconds between two statuses of a history, while it is short."""

REPLACED_WITHIN_S = 1.0
"""Longer than it takes to read or to replace a small file: who may not for as long may not at all."""


Done = TypeVar("Done")


class History:
    """The statuses that are kept of a run: they begin with those of its folder, if it was begun before.

    Args:
        path: the file.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._kept = _lines(path)
        self._every_s = KEEP_EVERY_S
        self._next = 0.0
        if self._kept:
            self._thin()

    def add(self, at: float, line: str, is_last: bool) -> None:
        """Keep a status if it is time to, or if it is the last one. Raise OSError if the disk refuses."""
        if at < self._next and not is_last:
            return
        self._next = at + self._every_s
        self._kept.append(line)
        if len(self._kept) > MOST_KEPT:
            self._every_s *= 2
            self._thin()
        else:
            with self._path.open("a", encoding="utf-8") as file:
                file.write(line + "\n")

    def _thin(self) -> None:
        while len(self._kept) > MOST_KEPT:
            self._kept = [self._kept[0], *self._kept[2::2]]
        _replace(self._path, "".join(line + "\n" for line in self._kept))


class StatusFiles:
    """Writes a run's status into its folder.

    Args:
        folder: a run's folder; its ``view`` is made where there is none.

    OSError, here and at every writing, if the disk refuses.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / FOLDER
        self.path.mkdir(parents=True, exist_ok=True)
        self._history = History(self.path / HISTORY)

    def write(self, status: Status) -> None:
        """Write what is now; keep it, if it is time to."""
        line = status.model_dump_json(exclude_defaults=True)
        with contextlib.suppress(PermissionError):  # Windows, while somebody reads it: the next one comes soon
            _replace(self.path / NOW, line)
        self._history.add(status.at, line, status.ended is not None)


def is_published(folder: Path) -> bool:
    """Return whether a living process writes that run's status."""
    return holder_of(folder / FOLDER) is not None


def status_now(folder: Path) -> Status:
    """Return the status of a run; raise RunError if there is none, or it can't be read."""
    path = folder / FOLDER / NOW
    try:
        return _status_of(_patiently(path.read_bytes), path)
    except PermissionError as error:
        raise RunError(f"{path}: can't be read, {error.strerror}: let this account read it") from error
    except (FileNotFoundError, NotADirectoryError) as error:
        why = "name the folder of a training (its --out), mc-nested runs lists them"
        if (folder / "config.toml").is_file():
            why = "it is an experiment: mc-nested runs show says what it holds"
        raise RunError(f"{folder}: there is nothing to view: {why}") from error


def history_of(folder: Path) -> Sequence[Status]:
    """Return the statuses kept of a run, the oldest first; a line that a kill cut off is left out."""
    path = folder / FOLDER / HISTORY
    kept = []
    for line in _lines(path):
        with contextlib.suppress(RunError):
            kept.append(_status_of(line, path))
    return kept


def remove_status(folder: Path) -> None:
    """Remove what was published of a run, and nothing else that may lie there."""
    path = folder / FOLDER
    for name in VIEW_FILES:
        with contextlib.suppress(OSError):
            (path / name).unlink(missing_ok=True)
    with contextlib.suppress(OSError):  # it isn't there, or holds something else
        path.rmdir()


def _patiently(do: Callable[[], Done]) -> Done:
    """Do what Windows refuses in the moments in which another process reads the file, or replaces it."""
    deadline = time.monotonic() + REPLACED_WITHIN_S
    while time.monotonic() < deadline:
        with contextlib.suppress(PermissionError):
            return do()
        time.sleep(0.01)
    return do()


def _lines(path: Path) -> list[str]:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:  # there is none, or it is just being replaced
        return []
    return [line for line in text.split("\n") if line]


def _status_of(text: str | bytes, path: Path) -> Status:
    try:
        return Status.model_validate_json(text)
    except ValidationError as error:
        raise RunError(f"{path}: can't be read: it is damaged, or of another version of mc-nested") from error


def _replace(path: Path, text: str) -> None:
    """Write all of it at once, without waiting for the disk: a power cut costs no more than a view of the past."""
    unfinished = path.with_suffix(".unfinished")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(path)


@dataclass(frozen=True)
class Scrubber:
    """A run's history, the oldest first, and the place in it that is shown; it holds one status at least."""

    history: Sequence[Status]
    place: int

    @property
    def status(self) -> Status:
        """What is shown."""
        return self.history[self.place]

    def moved(self, places: int) -> "Scrubber":
        """Return the history moved on by so many places, or back for a negative number; it stops at both ends."""
        return replace(self, place=min(max(self.place + places, 0), len(self.history) - 1))

    def jumped(self, tenths: int) -> "Scrubber":
        """Return the history moved on by so many tenths of the whole, by one place at least."""
        step = max(1, len(self.history) // 10)
        return self.moved(tenths * step)

    def line(self, width: int) -> Text:
        """Return the whole run as a line, with a mark where it is, and the times of its ends."""
        first, last = clock_time(self.history[0].at), clock_time(self.history[-1].at)
        room = max(1, width - len(first) - len(last) - 2)
        mark = self.place * (room - 1) // max(1, len(self.history) - 1)
        return Text.assemble(f"{first} ", ("━" * mark, "cyan"), ("●", "bold cyan"), "─" * (room - 1 - mark), f" {last}")


PAUSE, STOP, ANSWER, TAKEOVER = "pause.request", "stop.request", "answer.request", "takeover.request"

RENEWED_S = 5.0
"""Seconds after which a pause that nobody renewed is over: a view renews it three times a second."""


class YesOrNo(BaseModel):
    """Yes or no to the question of that number alone."""

    model_config = ConfigDict(frozen=True)

    number: int
    is_yes: bool


def ask(request: str, folder: Path) -> None:
    """Ask the run in a folder to pause, to stop (that can't be taken back), or to hand the game to the player or back.

    Raise OSError if nothing can be written there.
    """
    (folder / FOLDER / request).touch()


def renew_pause(folder: Path) -> bool:
    """Say that somebody still wants the pause; False where somebody asked to go on meanwhile."""
    path = folder / FOLDER / PAUSE
    if not path.exists():
        return False
    with contextlib.suppress(OSError):
        path.touch()
    return True


def ask_to_go_on(folder: Path) -> None:
    """Ask the run to go on. Raise OSError if the file can't be removed."""
    (folder / FOLDER / PAUSE).unlink(missing_ok=True)


def give_answer(folder: Path, answer: YesOrNo) -> None:
    """Answer the run's question. Raise OSError if nothing can be written there."""

    def write() -> None:
        with atomic_write(folder / FOLDER / ANSWER) as path:
            path.write_text(answer.model_dump_json(), encoding="utf-8")

    _patiently(write)


class Requests:
    """What is asked of the run in a folder; at first, nothing: what was asked of an earlier run is forgotten."""

    def __init__(self, folder: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder = folder / FOLDER
        self._clock = clock
        self._renewed: tuple[int, float] | None = None
        for name in (PAUSE, STOP, ANSWER, TAKEOVER):
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

    def takes_takeover(self) -> bool:
        """Return whether somebody asked to take over, or to give back, since the last call."""
        with contextlib.suppress(OSError):
            (self._folder / TAKEOVER).unlink()
            return True
        return False

    def answer_to(self, number: int) -> bool | None:
        """Return the answer to that question; None where there is none yet."""
        try:
            answer = YesOrNo.model_validate_json((self._folder / ANSWER).read_bytes())
        except (OSError, ValidationError):
            return None
        return answer.is_yes if answer.number == number else None
