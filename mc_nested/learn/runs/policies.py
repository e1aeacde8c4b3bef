"""The policies that a training keeps, in a file of their own: playing those of the compiled engine needs no torch.

``policies.npz`` stands beside the checkpoint that it was saved with, and names it by its hash. With another checkpoint,
as after a process was killed between the two, or beside one of an older version, it doesn't count.
"""

import hashlib
import zipfile
import zlib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.runs.checkpoint import Checkpoint

FILE = "policies.npz"

_IDENTITY, _SAVED_WITH, _KEPT = "identity", "saved_with", "kept."


def save_policies(checkpoint: Checkpoint, kept: Mapping[str, NDArray[Any]]) -> None:
    """Write the kept policies, by role, and their scores beside the checkpoint; OSError if the disk refuses.

    The same arrays and checkpoint write the same bytes.
    """
    arrays = {
        _IDENTITY: np.array(checkpoint.identity),
        _SAVED_WITH: np.array(_hash_of(checkpoint)),
        **{f"{_KEPT}{name}": array for name, array in kept.items()},
    }
    with atomic_write(checkpoint.file.with_name(FILE)) as path, path.open("wb") as file:
        np.savez(file, allow_pickle=False, **arrays)


def load_policies(checkpoint: Checkpoint, shapes: Mapping[str, tuple[int, ...]]) -> Arrays | None:
    """What ``save_policies`` wrote with this checkpoint; None where there is none, it is damaged, or of another save.

    RunError if they are another training's, or not of these ``shapes``, by name.
    """
    path = checkpoint.file.with_name(FILE)
    try:
        # Opened here: NumPy leaves a file open that it can't read.
        with path.open("rb") as file, np.load(file, allow_pickle=False) as found:
            identity, saved_with = str(found[_IDENTITY]), str(found[_SAVED_WITH])
            kept = {name.removeprefix(_KEPT): found[name] for name in found.files if name.startswith(_KEPT)}
            if saved_with != _hash_of(checkpoint):
                return None
    except (OSError, ValueError, TypeError, KeyError, EOFError, RuntimeError, zlib.error, zipfile.BadZipFile):
        return None  # TypeError: NumPy finds one array instead of an archive; RuntimeError: zipfile finds a password
    checkpoint.check_identity(identity)
    if misfit := misfit_of(kept, shapes):
        raise RunError(f"{path}: {misfit}: delete this file, the checkpoint beside it holds the policies too")
    return kept


def misfit_of(kept: Mapping[str, NDArray[Any]], shapes: Mapping[str, tuple[int, ...]]) -> str | None:
    """What keeps these arrays from being policies of these shapes, by name, and their ``scores``; None if they fit."""
    for name, shape in shapes.items():
        if name not in kept:
            return f"has no array {name}"
        array = kept[name]
        if array.shape != shape:
            return f"its array {name} is {array.shape}, it should be {shape}"
        # A policy that was never played has the score -inf.
        if array.dtype.kind != "f" or not (np.isfinite(array) | (name == "scores") & np.isneginf(array)).all():
            return f"its array {name} holds what is no number"
    return None


def _hash_of(checkpoint: Checkpoint) -> str:
    return hashlib.sha256(checkpoint.file.read_bytes()).hexdigest()
