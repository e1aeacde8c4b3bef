"""What compiled code does with vectors of neighbouring numbers of an array, in LLVM's language, since Numba's has none.

A sum of products: eight sums side by side, then the sum of those, in one order on every processor. A tile of a matrix
product: its sums stay in the processor's registers until they are whole, where a loop of Numba's would store and load
each again. A block that is transposed there. LLVM divides a vector into those that the processor has.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON

INDEX = ir.IntType(32)
"""The type of a constant that says which of a vector's numbers is meant."""

FUSED = ("contract",)
"""A product and a sum may be one instruction, which rounds once."""

ALIGNED = 4
"""Bytes: a vector may begin at any 32-bit float."""


class Vectors:
    """The numbers of an array (rows, columns) of 32-bit floats, alone or so many side by side.

    Args:
        context: Numba's, of what is being compiled.
        builder: of the function that is being compiled.
        kind: the array's type.
        array: the array.
        width: the numbers of a vector.
    """

    def __init__(self, context: Any, builder: Any, kind: Any, array: Any, width: int) -> None:
        self._context, self._builder, self._kind = context, builder, kind
        self._array = context.make_array(kind)(context, builder, array)
        self._vector = ir.VectorType(ir.FloatType(), width).as_pointer()

    @property
    def rows(self) -> Any:
        """How many rows there are."""
        return self._builder.extract_value(self._array.shape, 0)

    def number(self, row: Any, column: Any) -> Any:
        """Return the number at a place."""
        return self._builder.load(self._place(row, column))

    def load(self, row: Any, column: Any) -> Any:
        """Return the vector of a row's numbers from that column on."""
        return self._builder.load(self._begin(row, column), align=ALIGNED)

    def store(self, vector: Any, row: Any, column: Any) -> None:
        """Make it a row's numbers from that column on."""
        self._builder.store(vector, self._begin(row, column), align=ALIGNED)

    def _begin(self, row: Any, column: Any) -> Any:
        return self._builder.bitcast(self._place(row, column), self._vector)

    def _place(self, row: Any, column: Any) -> Any:
        at = self._context, self._builder, self._kind, self._array, (row, column)
        return cgutils.get_item_pointer(*at)  # type: ignore[no-untyped-call]


LANES = 8
"""Sums side by side."""

SumInLanes = Callable[[Float32s, int, Float32s, int], np.float32]
"""``sum_in_lanes(a, row, b, terms)``: the sum of that many products of a row of ``a`` and the first of ``b``.

``terms`` is a multiple of LANES. A row of either lies in one piece. The bounds are checked in plain Python only.
"""


def _sum_in_python(a: Float32s, row: int, b: Float32s, terms: int) -> np.float32:
    places = range(terms)
    products = a[row].take(places) * b[0].take(places)
    total: np.float32 = products.sum()
    return total


def _compiled_sum(_: Any, a: Any, row: Any, b: Any, terms: Any) -> Any:
    return types.float32(a, row, b, terms), _generate_sum


def _generate_sum(context: Any, builder: Any, signature: Any, given: Any) -> Any:
    kind_a, _, kind_b, _ = signature.args
    a, row, b, terms = given
    rows, factors = Vectors(context, builder, kind_a, a, LANES), Vectors(context, builder, kind_b, b, LANES)
    total = cgutils.alloca_once(builder, ir.VectorType(ir.FloatType(), LANES), zfill=True)  # type: ignore[no-untyped-call]
    none, step = terms.type(0), terms.type(LANES)
    with cgutils.for_range_slice(builder, none, terms, step, inc=True) as (term, _):
        product = builder.fmul(rows.load(row, term), factors.load(none, term), flags=FUSED)
        builder.store(builder.fadd(builder.load(total), product, flags=FUSED), total)
    lanes = builder.load(total)
    half = LANES
    while half > 1:
        half //= 2
        others = ir.Constant(ir.VectorType(INDEX, LANES), [(lane + half) % LANES for lane in range(LANES)])
        lanes = builder.fadd(lanes, builder.shuffle_vector(lanes, lanes, others))
    return builder.extract_element(lanes, INDEX(0))


_sum: Any = _sum_in_python if IN_PYTHON else intrinsic(_compiled_sum)
sum_in_lanes: SumInLanes = _sum


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
    """Return the tile of so many rows, for compiled code."""

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
    """Return a vector with that number everywhere."""
    unknown, first = ir.Constant(_VECTOR, ir.Undefined), ir.Constant(INDEX, 0)
    with_one = builder.insert_element(unknown, number, first)
    return builder.shuffle_vector(with_one, unknown, ir.Constant(ir.VectorType(INDEX, WIDTH), [0] * WIDTH))


multiply_rows, multiply_a_row = _tile_of(ROWS), _tile_of(1)


SIDE = 8
"""Rows and columns of a block. Number by number, transposing it would take four times as long."""

Transpose = Callable[[Float32s, tuple[int, int], Float32s, tuple[int, int]], None]
"""``transpose(a, at, out, to)``: the block of ``a`` from the row and column ``at`` on is transposed and written
into ``out`` from ``to`` on.

A row of either lies in one piece. The bounds are checked in plain Python only.
"""


def _mask(*numbers: int) -> ir.Constant:
    """Return which numbers of two vectors, one after the other, a new vector has."""
    return ir.Constant(ir.VectorType(INDEX, SIDE), list(numbers))


_STAGES = (
    (1, _mask(0, 8, 1, 9, 4, 12, 5, 13), _mask(2, 10, 3, 11, 6, 14, 7, 15)),
    (2, _mask(0, 1, 8, 9, 4, 5, 12, 13), _mask(2, 3, 10, 11, 6, 7, 14, 15)),
    (4, _mask(0, 1, 2, 3, 8, 9, 10, 11), _mask(4, 5, 6, 7, 12, 13, 14, 15)),
)
"""Each stage makes of two vectors, so far apart, two others: AVX has one instruction for each of these choices."""

_COLUMN_OF = (0, 2, 1, 3, 4, 6, 5, 7)
"""Which column each vector holds after the stages."""


def _transposed_in_python(a: Float32s, at: tuple[int, int], out: Float32s, to: tuple[int, int]) -> None:
    (row, column), (to_row, to_column) = at, to
    block = a.take(range(row, row + SIDE), axis=0).take(range(column, column + SIDE), axis=1)
    out[np.ix_(range(to_row, to_row + SIDE), range(to_column, to_column + SIDE))] = block.T


def _compiled_transpose(_: Any, a: Any, at: Any, out: Any, to: Any) -> Any:
    return types.void(a, at, out, to), _generate_transpose


def _generate_transpose(context: Any, builder: Any, signature: Any, given: Any) -> Any:
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


_transpose: Any = _transposed_in_python if IN_PYTHON else intrinsic(_compiled_transpose)
transpose_block: Transpose = _transpose
