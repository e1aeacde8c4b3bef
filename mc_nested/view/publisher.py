"""Publisher: a thread that writes a run's board where its view looks, and does what is asked there."""

import contextlib
import itertools
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.view.board import Board
from mc_nested.view.files import FOLDER, Requests, StatusFiles

PUBLISH_EVERY_S = 0.3
"""Three times a second: no more often than an eye can follow, and a hundredth of a core."""

LOOK_S = 0.05

LOCK_PATIENCE_S = 1.0
"""A view that looks whether the run lives holds its lock for an instant."""

BACK_WITHIN_S = 60.0
"""Seconds that a person has, after a pause, to have the game in front again."""


class Publisher:
    """Publishes a board in a run's folder while the block runs, as a context manager.

    If the folder can't be written, the view is lost, never the run. Requests are read at every publishing.

    Args:
        board: what is published.
        folder: the run's folder.
        lines: the last lines that the run said.
        stop: stops the run, as Ctrl+C would.
    """

    def __init__(
        self,
        board: Board,
        folder: Path,
        lines: Callable[[], Sequence[str]] = tuple,
        stop: Callable[[], None] | None = None,
    ) -> None:
        self.board = board
        self.paused_s = 0.0
        """Seconds that the run has waited in pauses."""
        self._folder = folder
        self._lines = lines
        self._stop = stop or press_ctrl_c
        self._requests: Requests | None = None
        self._is_pause_asked = self._is_stopped = False
        self._switch: Callable[[], None] | None = None
        self._pause_ended_at = -BACK_WITHIN_S
        self._questions = itertools.count(time.time_ns() // 1_000_000)
        self._over = threading.Event()
        self._lock = contextlib.ExitStack()
        self._files: StatusFiles | None = None
        self._thread = threading.Thread(target=self._run, name="publisher", daemon=True)

    def __enter__(self) -> "Publisher":
        with contextlib.suppress(OSError, RunError):
            self._files = StatusFiles(self._folder)
            self._requests = Requests(self._folder)
            self._lock.enter_context(folder_lock(self._folder / FOLDER, LOCK_PATIENCE_S))
        self._publish()
        self._thread.start()
        return self

    def __exit__(self, _: object, error: BaseException | None, *__: object) -> None:
        self._over.set()
        try:
            self._thread.join()
        finally:
            self.board.show(ended=_end_of(error), question=None, paused=False)
            self._publish()
            self._lock.close()

    @property
    def is_paused(self) -> bool:
        """Whether somebody wants a pause, and nobody a stop."""
        return self._is_pause_asked and not self._is_stopped

    @property
    def was_paused_lately(self) -> bool:
        """Whether there is a pause, or was one so shortly before that a person may not be back at the game yet."""
        return self.is_paused or time.monotonic() - self._pause_ended_at < BACK_WITHIN_S

    def wait_while_paused(self, ends: Callable[[], bool] = lambda: False) -> None:
        """Return at once; or, where somebody wants a pause, once they ask to go on or to stop, or it ends."""
        if not self.is_paused:
            return
        began = time.monotonic()
        self.board.show(paused=True)
        while self.is_paused and not ends():
            time.sleep(LOOK_S)
        self.board.go_on()
        self._pause_ended_at = time.monotonic()
        self.paused_s += self._pause_ended_at - began

    @contextlib.contextmanager
    def offer_takeover(self, switch: Callable[[], None]) -> Iterator[None]:
        """While the block runs, a view may have a player take over, or give back: ``switch`` does so, in a thread."""
        self._switch = switch
        self.board.show(can_take_over=True)
        try:
            yield
        finally:
            self._switch = None
            self.board.show(can_take_over=False)

    def answer(self, question: str, is_seen: Callable[[], bool] = lambda: True) -> bool | None:
        """Wait for a person's yes or no to a question in the view; return None once nobody sees it any more."""
        number = next(self._questions)
        self.board.show(question=question, question_number=number)
        try:
            while (answer := self._requests.answer_to(number) if self._requests else None) is None and is_seen():
                time.sleep(LOOK_S)
            return answer
        finally:
            self.board.show(question=None)

    def _run(self) -> None:
        while not self._over.wait(PUBLISH_EVERY_S):
            self._hear()
            self._publish()

    def _publish(self) -> None:
        # A status that can't be written, whatever it holds, costs this one view of it.
        with contextlib.suppress(OSError, ValueError):
            if self._files:
                self.board.show(lines=tuple(self._lines()))
                self._files.write(self.board.status())

    def _hear(self) -> None:
        if self._requests is None:
            return
        self._is_pause_asked = self._requests.is_pause_asked()
        self.board.show(pausing=self.is_paused)
        if self._requests.takes_takeover() and (switch := self._switch):
            switch()
        if self._requests.is_stop_asked() and not self._is_stopped:
            self._is_stopped = True
            self.board.show(stopping=True)
            self._stop()


def press_ctrl_c() -> None:
    """Do what Ctrl+C in the run's terminal does."""
    if sys.platform == "win32":
        import _thread

        _thread.interrupt_main()
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)


def _end_of(error: BaseException | None) -> str:
    """Return how a run ended, in words."""
    if error is None:
        return "finished"
    return " ".join(str(error).split()) or "stopped"
