"""A training's log: a row for each finished training episode, and one for each greedy evaluation."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeVar, get_type_hints

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float64s


class EpisodeRow(NamedTuple):
    """One finished training episode; ``episode`` counts from 1, ε is what it was played with (1 for an excursion)."""

    trial: int
    episode: int
    score: float
    material: int
    steps: int
    epsilon_main: float
    epsilon_nested: float


class EvaluationRow(NamedTuple):
    """One greedy episode after ``episode`` training episodes."""

    trial: int
    episode: int
    score: float
    material: int
    steps: int


Row = TypeVar("Row")


def table_of_rows(rows: Sequence[object], kind: type) -> Float64s:
    """Put the rows, named tuples of numbers of that kind, into an array, a column a field."""
    return np.array(rows, dtype=np.float64).reshape(len(rows), len(get_type_hints(kind)))


def rows_of_table(table: NDArray[Any], kind: Callable[..., Row]) -> list[Row]:
    """Return the rows that ``table_of_rows`` turned into that table."""
    types = get_type_hints(kind).values()
    return [kind(*(field(value) for field, value in zip(types, row, strict=True))) for row in table.tolist()]
