"""Wine's services, which no parent waits for: this process adopts them, so that none stays listed after its end.

An ended process stays listed until its parent, or else the system's first process, collects its status. In many
containers the first process never does. Linux, standard library only.
"""

import ctypes
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from scripts.standin_processes import wait_until

_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h
_PATIENCE_S = 5.0


@contextmanager
def adopting() -> Iterator[None]:
    """In the block, Windows programs whose parent has ended become this process's; at its end they are collected."""
    libc = ctypes.CDLL(None)
    libc.prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    try:
        yield
    finally:
        wait_until(_has_collected_all, _PATIENCE_S)
        libc.prctl(_PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0)


def _has_collected_all() -> bool:
    """Collect the Windows programs that have ended; whether there is none left of this process's."""
    left = [pid for pid in _windows_children() if not _is_collected(pid)]
    return not left


def _is_collected(pid: int) -> bool:
    with suppress(ChildProcessError):
        return os.waitpid(pid, os.WNOHANG)[0] == pid
    return True


def _windows_children() -> list[int]:
    """This process's children that Wine has named after a Windows program, such as services.exe."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                name, fields = (
                    (entry / "stat").read_text(encoding="utf-8", errors="replace").split("(", 1)[1].rsplit(")", 1)
                )
                if int(fields.split()[1]) == os.getpid() and name.endswith(".exe"):
                    found.append(int(entry.name))
    return found
