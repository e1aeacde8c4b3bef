"""Files of arrays that a test has changed."""

from collections.abc import Callable
from pathlib import Path

from mc_nested.arrays import Arrays
from mc_nested.learn.runs.checkpoint import Checkpoint


def change_arrays(file: Path, change: Callable[[Arrays], object]) -> None:
    """Change the arrays in a checkpoint's file, which is whole then."""
    folder = Checkpoint(file.parent, {})
    arrays = folder._read(file.name)
    change(arrays)
    folder._write(file.name, arrays)
