"""Vectors of neighbouring numbers of an array, in LLVM's language, since Numba's has none."""

from typing import Any

from llvmlite import ir
from numba.core import cgutils

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
        """The number at a place."""
        return self._builder.load(self._place(row, column))

    def load(self, row: Any, column: Any) -> Any:
        """The vector of a row's numbers from that column on."""
        return self._builder.load(self._begin(row, column), align=ALIGNED)

    def store(self, vector: Any, row: Any, column: Any) -> None:
        """Make it a row's numbers from that column on."""
        self._builder.store(vector, self._begin(row, column), align=ALIGNED)

    def _begin(self, row: Any, column: Any) -> Any:
        return self._builder.bitcast(self._place(row, column), self._vector)

    def _place(self, row: Any, column: Any) -> Any:
        at = self._context, self._builder, self._kind, self._array, (row, column)
        return cgutils.get_item_pointer(*at)  # type: ignore[no-untyped-call]
