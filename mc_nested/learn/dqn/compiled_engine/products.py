"""Matrix products of the size of these networks, compiled.

A BLAS is made for matrices of thousands of rows. With one, the paper's experiment took 1.4 times as long
(CHANGELOG.md), and how many threads it took changed the last digits.
"""

import numpy as np

from mc_nested.arrays import Float32s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.tiles import ROWS, WIDTH, multiply_a_row, multiply_rows

FEW = 6
"""Up to so many columns, a sum after the other takes less time than a tile."""


@compiled(nogil=True)
def multiply(a: Float32s, b: Float32s, out: Float32s) -> None:
    """Write the product of ``a`` (rows, terms) and ``b`` (terms, columns) into ``out`` (rows, columns).

    ``a`` and ``b`` may be transposed; a row of ``out`` lies in one piece.
    """
    terms, columns = b.shape
    whole = columns // WIDTH * WIDTH
    if b.strides[1] == b.itemsize:
        for column in range(0, whole, WIDTH):
            _multiply_columns(a, b, column, out, column)
    elif whole:
        packed = np.empty((terms, WIDTH), np.float32)
        for first in range(0, whole, WIDTH):
            for term in range(terms):
                for column in range(WIDTH):
                    packed[term, column] = b[term, first + column]
            _multiply_columns(a, packed, 0, out, first)
    if columns - whole > FEW:
        _multiply_rest(a, b, whole, out)
    elif columns > whole:
        _multiply_few(a, b, whole, out)


@compiled(nogil=True)
def _multiply_rest(a: Float32s, b: Float32s, first: int, out: Float32s) -> None:
    """The product with the columns of ``b`` from that one on, fewer than WIDTH: zeros make a tile of them."""
    rest = b.shape[1] - first
    packed, product = np.zeros((b.shape[0], WIDTH), np.float32), np.empty((out.shape[0], WIDTH), np.float32)
    for column in range(rest):
        for term in range(b.shape[0]):
            packed[term, column] = b[term, first + column]
    _multiply_columns(a, packed, 0, product, 0)
    for row in range(out.shape[0]):
        for column in range(rest):
            out[row, first + column] = product[row, column]


@compiled(fastmath=True, nogil=True)
def _multiply_few(a: Float32s, b: Float32s, first: int, out: Float32s) -> None:
    """The product with the columns of ``b`` from that one on, one sum at a time."""
    factors = np.empty(b.shape[0], np.float32)
    for column in range(first, b.shape[1]):
        for term in range(len(factors)):
            factors[term] = b[term, column]
        for row in range(out.shape[0]):
            total = np.float32(0)
            for term in range(len(factors)):
                total += a[row, term] * factors[term]
            out[row, column] = total


@compiled(nogil=True)
def _multiply_columns(a: Float32s, b: Float32s, column: int, out: Float32s, to_column: int) -> None:
    """The product with WIDTH columns of ``b``, whose rows lie in one piece each."""
    rows = out.shape[0]
    if rows < ROWS:
        for row in range(rows):
            multiply_a_row(a, row, b, column, out, (row, to_column))
        return
    for row in range(0, rows, ROWS):
        at = min(row, rows - ROWS)  # the last tile may compute again what another has computed
        multiply_rows(a, at, b, column, out, (at, to_column))
