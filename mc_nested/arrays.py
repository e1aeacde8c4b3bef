"""Types of NumPy arrays, by dtype, and states as arrays by name: each part's are saved with its name in front."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Bools = NDArray[np.bool_]
Float32s = NDArray[np.float32]
Float64s = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Int8s = NDArray[np.int8]
Int32s = NDArray[np.int32]
Int64s = NDArray[np.int64]
Integers = NDArray[np.integer[Any]]
"""Whole numbers of any width: a replay keeps small ones."""

Arrays = dict[str, NDArray[Any]]
"""Arrays by name: a saved state, or a part of one."""


def part_of(state: Mapping[str, NDArray[Any]], part: str) -> Arrays:
    """Return the entries of a saved state that belong to one of its parts, under the part's own names."""
    return {name.removeprefix(f"{part}."): kept for name, kept in state.items() if name.startswith(f"{part}.")}


def named_for(part: str, state: Mapping[str, NDArray[Any]]) -> Arrays:
    """Return a part's entries under the names that ``part_of`` finds them by."""
    return {f"{part}.{name}": kept for name, kept in state.items()}


def named_parts(parts: Mapping[str, Mapping[str, NDArray[Any]]]) -> Arrays:
    """Return the entries of all these parts, by name, as ``named_for`` of each."""
    return {name: kept for part, state in parts.items() for name, kept in named_for(part, state).items()}


def copied(state: Mapping[str, NDArray[Any]]) -> Arrays:
    """Return a copy of each array."""
    return {name: array.copy() for name, array in state.items()}
