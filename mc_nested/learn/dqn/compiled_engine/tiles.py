"""A tile of a matrix product, whose sums stay in the processor's registers until they are whole.

What is written here is LLVM's language, since Numba's has no vectors: in a loop of Numba's every term would store its
sum and load it again. LLVM divides a vector of sixteen numbers into those that the processor has.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON

ROWS, WIDTH = 5, 16
"""The larger tile: its sums and what is multiplied fit into AVX2's sixteen registers of eight numbers."""

_VECTOR = ir.VectorType(ir.FloatType(), WIDTH)
_INDEX = ir.IntType(32)
_FUSED = ("contract",)
"""A product and a sum may be one instruction, which rounds once."""
_ALIGNED = 4
"""Bytes: a vector may begin at any 32-bit float."""

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
        factors, vectors = _Places(context, builder, kind_a, a), _Places(context, builder, kind_b, b)
        products = _Places(context, builder, kind_out, out)
        sums = [cgutils.alloca_once(builder, _VECTOR, zfill=True) for _ in range(rows)]  # type: ignore[no-untyped-call]
        with cgutils.for_range(builder, builder.extract_value(vectors.shape, 0)) as terms:
            vector = builder.load(vectors.vector(terms.index, column), align=_ALIGNED)
            for row, total in enumerate(sums):
                factor = builder.load(factors.number(builder.add(first, first.type(row)), terms.index))
                product = builder.fmul(_everywhere(builder, factor), vector, flags=_FUSED)
                builder.store(builder.fadd(builder.load(total), product, flags=_FUSED), total)
        to_row, to_column = (builder.extract_value(to, at) for at in range(2))
        for row, total in enumerate(sums):
            place = products.vector(builder.add(to_row, to_row.type(row)), to_column)
            builder.store(builder.load(total), place, align=_ALIGNED)
        return context.get_dummy_value()

    tile: Any = in_python if IN_PYTHON else intrinsic(compiled)
    made: Tile = tile
    return made


class _Places:
    """Where the numbers of an array (rows, columns) are."""

    def __init__(self, context: Any, builder: Any, kind: Any, array: Any) -> None:
        self._context, self._builder, self._kind = context, builder, kind
        self._array = context.make_array(kind)(context, builder, array)
        self.shape = self._array.shape

    def number(self, row: Any, column: Any) -> Any:
        """The place of a number."""
        at = self._context, self._builder, self._kind, self._array, (row, column)
        return cgutils.get_item_pointer(*at)  # type: ignore[no-untyped-call]

    def vector(self, row: Any, column: Any) -> Any:
        """The place of WIDTH numbers from there on."""
        return self._builder.bitcast(self.number(row, column), _VECTOR.as_pointer())


def _everywhere(builder: Any, number: Any) -> Any:
    """A vector with that number everywhere."""
    unknown, first = ir.Constant(_VECTOR, ir.Undefined), ir.Constant(_INDEX, 0)
    with_one = builder.insert_element(unknown, number, first)
    return builder.shuffle_vector(with_one, unknown, ir.Constant(ir.VectorType(_INDEX, WIDTH), [0] * WIDTH))


multiply_rows, multiply_a_row = _tile_of(ROWS), _tile_of(1)
