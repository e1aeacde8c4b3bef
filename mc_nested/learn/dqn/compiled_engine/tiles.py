"""A tile of a matrix product, whose sums stay in the processor's registers until they are whole.

In a loop of Numba's every term would store its sum and load it again. LLVM divides a vector of sixteen numbers into
those that the processor has.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON
from mc_nested.learn.dqn.compiled_engine.vectors import FUSED, INDEX, Vectors

ROWS, WIDTH = 5, 16
"""The larger tile: its sums and what is multiplied fit into AVX2's sixteen registers of eight numbers."""

_VECTOR = ir.VectorType(ir.FloatType(), WIDTH)

Tile = Callable[[Float32s, int, Float32s, int, Float32s, tuple[int, int]], None]
"""``tile(a, row, b, column, out, to)``: some rows of ``a``, from that one on, times WIDTH columns of ``b``, from that
one on, are written into ``out`` at ``to``.

``a`` is (…, terms), ``b`` (terms, …); a row of ``b`` and of ``out`` lies in one piece. The bounds are checked in
plain Python only.
"""


def _tile_of(rows: int) -> Tile:
    """The tile of so many rows, for compiled code."""

    def in_python(a: Float32s, row: int, b: Float32s, column: int, out: Float32s, to: tuple[int, int]) -> None:
        factors, vectors = a.take(range(row, row + rows), axis=0), b.take(range(column, column + WIDTH), axis=1)
        out[np.ix_(range(to[0], to[0] + rows), range(to[1], to[1] + WIDTH))] = factors @ vectors

    def compiled(_: Any, a: Any, row: Any, b: Any, column: Any, out: Any, to: Any) -> Any:
        return types.void(a, row, b, column, out, to), generate

    def generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
        kind_a, _, kind_b, _, kind_out, _ = signature.args
        a, first, b, column, out, to = given
        factors, vectors = Vectors(context, builder, kind_a, a, WIDTH), Vectors(context, builder, kind_b, b, WIDTH)
        products = Vectors(context, builder, kind_out, out, WIDTH)
        sums = [cgutils.alloca_once(builder, _VECTOR, zfill=True) for _ in range(rows)]  # type: ignore[no-untyped-call]
        with cgutils.for_range(builder, vectors.rows) as terms:
            vector = vectors.load(terms.index, column)
            for row, total in enumerate(sums):
                factor = factors.number(builder.add(first, first.type(row)), terms.index)
                product = builder.fmul(_everywhere(builder, factor), vector, flags=FUSED)
                builder.store(builder.fadd(builder.load(total), product, flags=FUSED), total)
        to_row, to_column = (builder.extract_value(to, at) for at in range(2))
        for row, total in enumerate(sums):
            products.store(builder.load(total), builder.add(to_row, to_row.type(row)), to_column)
        return context.get_dummy_value()

    tile: Any = in_python if IN_PYTHON else intrinsic(compiled)
    made: Tile = tile
    return made


def _everywhere(builder: Any, number: Any) -> Any:
    """A vector with that number everywhere."""
    unknown, first = ir.Constant(_VECTOR, ir.Undefined), ir.Constant(INDEX, 0)
    with_one = builder.insert_element(unknown, number, first)
    return builder.shuffle_vector(with_one, unknown, ir.Constant(ir.VectorType(INDEX, WIDTH), [0] * WIDTH))


multiply_rows, multiply_a_row = _tile_of(ROWS), _tile_of(1)
