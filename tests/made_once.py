"""Folders made once for a whole run of tests, by whichever of xdist's processes asks first."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from scripts.programs import alone


def made_once(name: str, make: Callable[[Path], None], factory: pytest.TempPathFactory) -> Path:
    """Return the folder of that name, which ``make`` fills once; other processes wait meanwhile.

    Never change its files.

    Linux only, for its lock. Where ``make`` fails, the next that asks tries anew.
    """
    own = factory.getbasetemp()
    shared = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
    folder, lock, done = shared / name, shared / f"{name}-lock", shared / f"{name}-lock" / "done"
    lock.mkdir(exist_ok=True)
    with alone(lock, print, name):
        if not done.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            make(folder)
            done.touch()
    return folder
