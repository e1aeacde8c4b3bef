"""A process that stays behind as the parent of others, so that their ends are collected.

Ended processes stay in the list until their parent, or else the system's first process, asks how they ended. In many
containers the first process never asks. Linux, standard library only.
"""

import ctypes
import os
import signal
import traceback
from collections.abc import Callable
from typing import NoReturn

_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h

Work = Callable[[], int]


def stay_behind(work: Work) -> int:
    """Run ``work`` in a process that stays for as long as anything that it started; returns what ``work`` returns.

    Ctrl+C here is SIGTERM there, and the work is then waited for. What it raises is printed there, and gives 1.
    """
    result, report = os.pipe()
    keeper = os.fork()
    if keeper == 0:
        _keep(work, report)
    os.close(report)
    said = b""
    while not said:
        said = _read(result, keeper)
    os.close(result)
    return said[0]


def _read(result: int, keeper: int) -> bytes:
    """The keeper's report, empty after Ctrl+C; a keeper that ends without one counts as 1."""
    try:
        return os.read(result, 1) or b"\x01"
    except KeyboardInterrupt:
        os.kill(keeper, signal.SIGTERM)
        return b""


def _keep(work: Work, report: int) -> NoReturn:
    """The keeper's whole life."""
    code = 1
    try:
        os.setsid()
        # A lock that the starting script holds would be held for as long as this process lives.
        os.closerange(3, report)
        os.closerange(report + 1, os.sysconf("SC_OPEN_MAX"))
        ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        code = work()
        _let_go_of_the_terminal()
        os.write(report, bytes([code]))
        os.close(report)
        _collect_until_none_is_left()
    except BaseException:
        traceback.print_exc()
    finally:
        # Not sys.exit: the caller's own way out is not this process's.
        os._exit(code)


def _collect_until_none_is_left() -> None:
    try:
        while True:
            os.wait()
    except ChildProcessError:  # there is nothing left to wait for
        return


def _let_go_of_the_terminal() -> None:
    nothing = os.open(os.devnull, os.O_RDWR)
    for each in (0, 1, 2):
        os.dup2(nothing, each)
