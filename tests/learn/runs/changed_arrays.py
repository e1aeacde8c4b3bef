"""Files of arrays that a test has changed."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from mc_nested.arrays import Arrays


def change_arrays(file: Path, change: Callable[[Arrays], object]) -> None:
    """Change the arrays in a checkpoint's file."""
    with np.load(file) as found:
        arrays = dict(found)
    change(arrays)
    np.savez(file, allow_pickle=False, **arrays)
