"""The state of a training as named arrays: each part's arrays are saved with the part's name in front."""

from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

from mc_nested.arrays import Arrays


def part_of(state: Mapping[str, NDArray[Any]], part: str) -> Arrays:
    """Return the entries of a saved state that belong to one of its parts, under the part's own names."""
    return {name.removeprefix(f"{part}."): kept for name, kept in state.items() if name.startswith(f"{part}.")}


def named_for(part: str, state: Mapping[str, NDArray[Any]]) -> Arrays:
    """Return a part's entries under the names that ``part_of`` finds them by."""
    return {f"{part}.{name}": kept for name, kept in state.items()}
