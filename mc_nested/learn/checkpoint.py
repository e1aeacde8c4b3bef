"""A training as a file, written so that a kill at any moment leaves the old one or the new one, whole."""

import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from pickle import UnpicklingError
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from mc_nested.errors import RunError
from mc_nested.learn.whole_file import written_whole

FILE = "state.pt"


def write_checkpoint(folder: Path, state: Mapping[str, NDArray[Any]], identity: Mapping[str, Any]) -> None:
    """Save arrays by name, with what they belong to; OSError where the disk refuses, the last one then intact."""
    folder.mkdir(exist_ok=True)
    with written_whole(folder / FILE) as path, path.open("wb") as file:
        tensors = {name: torch.from_numpy(np.ascontiguousarray(kept)) for name, kept in state.items()}
        torch.save({"identity": fingerprint(identity), "state": tensors}, file)
        file.flush()
        os.fsync(file.fileno())


def read_checkpoint(folder: Path, identity: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """The saved arrays; RunError where there are none, where they are cut short, or belong to something else."""
    path = folder / FILE
    if not path.is_file():
        raise RunError(f"{path}: there is no checkpoint yet: train this run first")
    try:
        saved = torch.load(path, map_location="cpu", weights_only=True)
        found, state = saved["identity"], saved["state"]
    except (OSError, RuntimeError, EOFError, UnpicklingError, KeyError, TypeError, ValueError) as error:
        raise RunError(
            f"{path}: the checkpoint is damaged or cut short: bring back a whole copy, or train the run anew"
        ) from error
    if found != fingerprint(identity):
        raise RunError(
            f"{path}: the checkpoint belongs to another scenario, agent or preset than this run's config.toml: "
            f"put back the config.toml it was trained with"
        )
    if not isinstance(state, dict):
        raise RunError(f"{path}: the checkpoint is damaged: bring back a whole copy, or train the run anew")
    return {name: kept.numpy() for name, kept in state.items()}


def fingerprint(identity: Mapping[str, Any]) -> str:
    """What the identity comes to, whatever the order of its keys."""
    return hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()


def part_of(state: Mapping[str, NDArray[Any]], whose: str) -> dict[str, NDArray[Any]]:
    """The entries of a saved state that belong to one of its parts, under the part's own names."""
    return {name.removeprefix(f"{whose}."): kept for name, kept in state.items() if name.startswith(f"{whose}.")}
