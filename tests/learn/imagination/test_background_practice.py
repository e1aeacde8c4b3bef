"""Practice beside a game: it overlaps with the reset, ends a second later, and goes on with a copy."""

import threading
import time
from collections.abc import Callable

import numpy as np
import pytest

from mc_nested.arrays import Float32s, Float64s
from mc_nested.errors import LiveError
from mc_nested.learn.dqn.compiled_engine.engine import Networks
from mc_nested.learn.imagination.background_practice import LONGER_S, BackgroundPractice, BackgroundThread, GoesOn
from mc_nested.learn.imagination.practice_kernel import Progress
from mc_nested.learn.imagination.practice_session import Goal, PracticeSession

FOR_EVER, PATIENCE_S = 10**9, 10.0


def row() -> Networks:
    online, target, first_moment, second_moment = np.zeros((4, 2), np.float32)
    return Networks(online, target, first_moment, second_moment, np.zeros(1, np.int64))


def session_of(
    own: Networks,
    most_updates: int = FOR_EVER,
    after: Callable[[], None] = lambda: None,
    by: int = 1,
    best: Float32s | None = None,
) -> PracticeSession:
    """Return a session whose updates add ``by`` to the online network, the best so far unless ``best`` is given."""

    def practise(numbers: Float64s, parts: Networks, progress: Progress) -> None:
        parts.online[:] += by * len(numbers)
        parts.updates[0] += len(numbers)
        progress.best[:] = parts.online if best is None else best
        if len(numbers):
            after()

    goal = Goal((0, 0), 1, 1, 1.0, most_updates, 0)
    return PracticeSession(own, lambda: None, practise, goal, np.random.default_rng(0), 1)


def worsening_session(own: Networks, after: Callable[[], None]) -> tuple[PracticeSession, Float32s]:
    """Return a session whose updates take 1 from the online network and so worsen it, and the best network."""
    best = np.array([1.0, 1.0], np.float32)
    return session_of(own, after=after, by=-1, best=best), best


class Steps:
    """A background whose work is done at its end, in that many rounds."""

    def __init__(self, times: int) -> None:
        self.times = times
        self.longer_s: list[float] = []
        self._work: Callable[[GoesOn], None] | None = None

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        self._work = work

    def end(self, longer_s: float = 0.0) -> None:
        if self._work is None:
            return
        left = iter(range(self.times))
        self._work(lambda: next(left, None) is not None)
        self.longer_s.append(longer_s)
        self._work = None


def threads() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name == "practice"]


def test_a_background_thread_works_until_its_time_is_up() -> None:
    now = [0.0]
    background = BackgroundThread(lambda: now[0])
    asked = 0

    def work(goes_on: GoesOn) -> None:
        nonlocal asked
        while goes_on():
            asked += 1
            now[0] += 0.25

    began = time.monotonic()
    background.begin(work)
    background.end(longer_s=1.0)
    assert time.monotonic() - began < PATIENCE_S
    assert asked >= 3
    assert not threads()


def test_ending_a_background_thread_without_more_time_stops_its_work() -> None:
    background = BackgroundThread()
    asked = threading.Event()

    def work(goes_on: GoesOn) -> None:
        while goes_on():
            asked.set()

    background.begin(work)
    assert asked.wait(PATIENCE_S), "it works beside this thread"
    background.end()
    assert not threads()


def test_ending_a_background_thread_raises_the_error_of_its_work_once() -> None:
    background = BackgroundThread()

    def fails(_: GoesOn) -> None:
        raise ConnectionError("no")

    background.begin(fails)
    with pytest.raises(ConnectionError, match="no"):
        background.end()
    background.end()
    background.begin(lambda _: None)
    background.end()


def test_practice_runs_while_the_game_resets() -> None:
    own, practised = row(), threading.Event()
    beside = BackgroundPractice(BackgroundThread())

    def reset() -> None:
        assert practised.wait(PATIENCE_S), "the reset waits for practice that runs meanwhile"

    beside.during_reset({0: session_of(own, 3, practised.set)}, reset)
    assert own.online.tolist() == [3, 3]


def test_practice_runs_for_a_second_at_most_after_the_reset() -> None:
    background = Steps(2)
    own = row()
    BackgroundPractice(background).during_reset({0: session_of(own)}, lambda: None)
    assert background.longer_s == [LONGER_S]
    assert own.updates[0] == 2


def test_a_failed_reset_ends_practice_at_once_and_raises_its_error() -> None:
    own, practised = row(), threading.Event()
    beside = BackgroundPractice(BackgroundThread())

    def reset() -> None:
        assert practised.wait(PATIENCE_S)
        raise LiveError("the game is gone")

    with pytest.raises(LiveError, match="the game is gone"):
        beside.during_reset({0: session_of(own, after=practised.set)}, reset)
    assert not threads()
    kept = own.online.copy()
    beside.end_of_episode()
    assert own.online.tolist() == kept.tolist()
    assert own.online[0] == own.updates[0] >= 1, "what was practised stays"


def test_a_failed_reset_leaves_the_best_networks_so_far() -> None:
    own, practised = row(), threading.Event()
    session, best = worsening_session(own, practised.set)

    def reset() -> None:
        assert practised.wait(PATIENCE_S)
        raise LiveError("the game is gone")

    with pytest.raises(LiveError, match="the game is gone"):
        BackgroundPractice(BackgroundThread()).during_reset({0: session}, reset)
    assert own.online.tolist() == own.target.tolist() == best.tolist()


def test_networks_practised_during_an_episode_are_taken_over_only_at_its_end() -> None:
    now = [0.0]

    def passes() -> None:
        practised.set()
        now[0] += LONGER_S

    own, practised = row(), threading.Event()
    beside = BackgroundPractice(BackgroundThread(lambda: now[0]))
    beside.during_reset({0: session_of(own, after=passes)}, lambda: None)
    played_by = own.online.copy()
    practised.clear()
    beside.during_episode()
    assert practised.wait(PATIENCE_S)
    assert own.online.tolist() == played_by.tolist()
    beside.end_of_episode()
    assert not threads()
    assert own.online[0] > played_by[0]
    assert own.online[0] == own.updates[0]


def test_the_best_policy_plays_an_episode_while_practice_continues_from_the_last_one() -> None:
    own, practised = row(), threading.Event()
    session, ends = worsening_session(own, practised.set)
    beside = BackgroundPractice(BackgroundThread())
    beside.during_reset({0: session}, lambda: None)
    last = own.online[0]
    beside.during_episode()
    assert own.online.tolist() == own.target.tolist() == ends.tolist()
    practised.clear()
    assert practised.wait(PATIENCE_S)
    beside.end_of_episode()
    assert session._parts.online[0] < last, "the copy went on from what was practised last"
    assert own.online.tolist() == own.target.tolist() == ends.tolist()


def test_a_finished_practice_neither_continues_nor_changes_the_networks() -> None:
    own, background = row(), Steps(9)
    beside = BackgroundPractice(background)
    beside.during_reset({0: session_of(own, 3)}, lambda: None)
    beside.during_episode()
    own.online[:] = 100.0
    beside.end_of_episode()
    assert own.online.tolist() == [100, 100]
    assert len(background.longer_s) == 1


def test_the_practice_sessions_of_all_runs_are_run() -> None:
    rows = {0: row(), 3: row()}
    BackgroundPractice(Steps(10)).during_reset({run: session_of(own, 2) for run, own in rows.items()}, lambda: None)
    assert [int(own.updates[0]) for own in rows.values()] == [2, 2]
