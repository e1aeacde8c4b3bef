"""A process that stays behind as the parent of others, and collects their exit statuses.

An ended process stays listed until its parent, or else the system's first process, collects its status. In many
containers the first process never does. Linux, standard library only.
"""

import ctypes
import os
import signal
import traceback
from collections.abc import Callable, Collection
from typing import NoReturn

_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h

Work = Callable[[], int]


def stay_behind(work: Work) -> int:
    """Run ``work`` in a process that stays as long as anything it started; returns what ``work`` returns.

    Ctrl+C is passed on as SIGTERM, and ``work`` is then waited for. An exception in it is printed, and counts as 1.
    """
    result, report = os.pipe()
    # Ctrl+C waits until it can be passed on: the work may begin before fork has returned here.
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        keeper = os.fork()
        if keeper == 0:
            _keep(work, report, before)
        os.close(report)
        said = b""
        while not said:
            said = _read(result, keeper)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    os.close(result)
    return said[0]


def _read(result: int, keeper: int) -> bytes:
    """The keeper's report, empty after Ctrl+C; a keeper that ends without one reports 1."""
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        return os.read(result, 1) or b"\x01"
    except KeyboardInterrupt:
        os.kill(keeper, signal.SIGTERM)
        return b""
    finally:
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})


def _keep(work: Work, report: int, signals: Collection[int]) -> NoReturn:
    """Run the keeper to its end, with these signals blocked, as the caller had them."""
    code = 1
    try:
        os.setsid()
        signal.pthread_sigmask(signal.SIG_SETMASK, signals)
        # Otherwise this process would keep the starting script's lock for as long as it lives.
        os.closerange(3, report)
        os.closerange(report + 1, os.sysconf("SC_OPEN_MAX"))
        ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        code = work()
        _release_terminal()
        os.write(report, bytes([code]))
        os.close(report)
        _collect_all()
    except BaseException:
        traceback.print_exc()
    finally:
        # Not sys.exit: the caller's cleanup must not run in this process.
        os._exit(code)


def _collect_all() -> None:
    try:
        while True:
            os.wait()
    except ChildProcessError:  # there is nothing left to wait for
        return


def _release_terminal() -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for each in (0, 1, 2):
        os.dup2(nothing, each)
