"""A block of a matrix turned round: its rows become columns, and stay in the processor's registers meanwhile.

Number by number it would take four times as long.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON
from mc_nested.learn.dqn.compiled_engine.vectors import INDEX, Vectors

SIDE = 8
"""Rows and columns of a block."""

Turn = Callable[[Float32s, tuple[int, int], Float32s, tuple[int, int]], None]
"""``turn(a, at, out, to)``: the block of ``a`` from the row and column ``at`` on is written, turned round, into ``out``
from ``to`` on.

A row of either lies in one piece. The bounds are checked in plain Python only.
"""


def _mask(*numbers: int) -> ir.Constant:
    """Which numbers of two vectors, one after the other, a new vector has."""
    return ir.Constant(ir.VectorType(INDEX, SIDE), list(numbers))


_STAGES = (
    (1, _mask(0, 8, 1, 9, 4, 12, 5, 13), _mask(2, 10, 3, 11, 6, 14, 7, 15)),
    (2, _mask(0, 1, 8, 9, 4, 5, 12, 13), _mask(2, 3, 10, 11, 6, 7, 14, 15)),
    (4, _mask(0, 1, 2, 3, 8, 9, 10, 11), _mask(4, 5, 6, 7, 12, 13, 14, 15)),
)
"""Each stage makes of two vectors, so far apart, two others: AVX has one instruction for each of these choices."""

_COLUMN_OF = (0, 2, 1, 3, 4, 6, 5, 7)
"""Which column each vector holds after the stages."""


def _in_python(a: Float32s, at: tuple[int, int], out: Float32s, to: tuple[int, int]) -> None:
    (row, column), (to_row, to_column) = at, to
    block = a.take(range(row, row + SIDE), axis=0).take(range(column, column + SIDE), axis=1)
    out[np.ix_(range(to_row, to_row + SIDE), range(to_column, to_column + SIDE))] = block.T


def _compiled(_: Any, a: Any, at: Any, out: Any, to: Any) -> Any:
    return types.void(a, at, out, to), _generate


def _generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
    kind_a, _, kind_out, _ = signature.args
    a, at, out, to = given
    rows, columns = Vectors(context, builder, kind_a, a, SIDE), Vectors(context, builder, kind_out, out, SIDE)
    row, column = (builder.extract_value(at, part) for part in range(2))
    to_row, to_column = (builder.extract_value(to, part) for part in range(2))
    vectors = [rows.load(builder.add(row, row.type(number)), column) for number in range(SIDE)]
    for apart, low, high in _STAGES:
        for first in (number for number in range(SIDE) if not number & apart):
            pair = vectors[first], vectors[first + apart]
            vectors[first], vectors[first + apart] = (builder.shuffle_vector(*pair, mask) for mask in (low, high))
    for vector, number in zip(vectors, _COLUMN_OF, strict=True):
        columns.store(vector, builder.add(to_row, to_row.type(number)), to_column)
    return context.get_dummy_value()


_turn: Any = _in_python if IN_PYTHON else intrinsic(_compiled)
turn_block: Turn = _turn
