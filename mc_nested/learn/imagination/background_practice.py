"""Practice before a simulated game's episode, or beside a live one's.

A simulated game waits until practice is over. A live game's time is a person's: nobody is to wait longer than a second
between two episodes. The compiled updates leave Python's lock to others, so a thread of its own does them. What isn't
over a second after the reset goes on while the game acts, on a copy of the networks: the policy that plays an episode,
the best so far, doesn't change within it. Before the next reset the best one since then takes its place.
"""

import threading
import time
from collections.abc import Callable, Mapping
from typing import Protocol

from mc_nested.learn.imagination.practice_session import PracticeSession

LONGER_S = 1.0
"""Seconds that practice may go on once the game stands ready."""

GoesOn = Callable[[], bool]


class Background(Protocol):
    """Where practice runs while a game is played: work that begins, and is ended later."""

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        """Begin that work; it asks often whether it is to go on. The last one has been ended."""

    def end(self, longer_s: float = 0.0) -> None:
        """Let the work go on for at most so many seconds, and wait for its end; without any, nothing.

        What the work raised passes through.
        """


class Foreground:
    """No background: the game waits until the work is done."""

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        """Do that work, to its end."""
        work(lambda: True)

    def end(self, longer_s: float = 0.0) -> None:
        """Do nothing: it has ended."""


class BackgroundThread:
    """Does its work in a thread. It goes on no longer than the main thread lives."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._thread: threading.Thread | None = None
        self._ends_at = float("inf")
        self._error: BaseException | None = None

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        self._ends_at, self._error = float("inf"), None
        self._thread = threading.Thread(target=self._do, args=(work,), name="practice")
        self._thread.start()

    def end(self, longer_s: float = 0.0) -> None:
        if self._thread is None:
            return
        self._ends_at = self._clock() + longer_s
        self._thread.join()
        self._thread = None
        if self._error:
            raise self._error

    def _do(self, work: Callable[[GoesOn], None]) -> None:
        try:
            work(self._goes_on)
        except BaseException as error:  # it is raised where the work is ended
            self._error = error

    def _goes_on(self) -> bool:
        return self._clock() < self._ends_at and threading.main_thread().is_alive()


class BackgroundPractice:
    """Practice of the runs whose games reset together.

    Args:
        background: where it runs.
    """

    def __init__(self, background: Background) -> None:
        self._background = background
        self._sessions: list[PracticeSession] = []

    def during_reset(self, sessions: Mapping[int, PracticeSession], reset: Callable[[], None]) -> None:
        """Run these sessions, by run, while the game resets, and LONGER_S after that.

        An error of the reset ends them and passes through; the best networks so far stay.
        """
        self._sessions = list(sessions.values())
        for session in self._sessions:
            session.prepare()
        self._begin()
        try:
            reset()
        except BaseException:
            self.end_of_episode()
            raise
        self._background.end(LONGER_S)

    def during_episode(self) -> None:
        """Go on with the practice that isn't over, on copies of the networks; the best networks so far play."""
        self._sessions = [session for session in self._sessions if not session.is_over]
        for session in self._sessions:
            session.go_on_with_a_copy()
        self._begin()

    def end_of_episode(self) -> None:
        """End the practice that goes on; the best networks that it found stay."""
        self._background.end()
        for session in self._sessions:
            session.take_over()
        self._sessions = []

    def _begin(self) -> None:
        sessions = self._sessions

        def run_them(goes_on: GoesOn) -> None:
            for session in sessions:
                session.run(goes_on)

        if sessions:
            self._background.begin(run_them)
