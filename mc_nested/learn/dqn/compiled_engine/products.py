"""Matrix products of the size of these networks, compiled.

A BLAS is made for matrices of thousands of rows. How many threads it takes changes the last digits.
"""

import numpy as np

from mc_nested.arrays import Float32s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.vectors import (
    LANES,
    ROWS,
    SIDE,
    WIDTH,
    multiply_a_row,
    multiply_rows,
    sum_in_lanes,
    transpose_block,
)

FEW = 2
"""Up to so many columns, one sum after the other takes less time than a tile."""


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
            _transpose(b.T, first, packed)
            _multiply_columns(a, packed, 0, out, first)
    if columns - whole > FEW:
        _multiply_rest(a, b, whole, out)
    elif columns > whole:
        _multiply_few(a, b, whole, out)


@compiled(nogil=True)
def _multiply_rest(a: Float32s, b: Float32s, first: int, out: Float32s) -> None:
    """Multiply by the columns of ``b`` from that one on, fewer than WIDTH, as the product of both transposed."""
    rows, terms = a.shape
    rest = b.shape[1] - first
    room = np.zeros((terms + rest, WIDTH), np.float32)
    packed, product = room[:terms], room[terms:]
    for row in range(0, rows, WIDTH):
        _transpose(a, row, packed)
        _multiply_columns(b.T[first:], packed, 0, product, 0)
        for column in range(rest):
            for each in range(min(WIDTH, rows - row)):
                out[row + each, first + column] = product[column, each]


@compiled(nogil=True)
def _multiply_few(a: Float32s, b: Float32s, first: int, out: Float32s) -> None:
    """Multiply by the columns of ``b`` from that one on, one sum at a time."""
    terms = b.shape[0]
    in_lanes = terms // LANES * LANES if a.strides[1] == a.itemsize else 0
    factors = np.empty((1, terms), np.float32)
    for column in range(first, b.shape[1]):
        for term in range(terms):
            factors[0, term] = b[term, column]
        for row in range(out.shape[0]):
            total = sum_in_lanes(a, row, factors, in_lanes)
            for term in range(in_lanes, terms):
                total += a[row, term] * factors[0, term]
            out[row, column] = total


@compiled(nogil=True)
def _transpose(a: Float32s, row: int, out: Float32s) -> None:
    """Write WIDTH rows of ``a`` (…, numbers) from that one on, or what there is, into the columns of ``out``."""
    rows, numbers = min(WIDTH, len(a) - row), a.shape[1]
    of_rows, of_numbers = rows // SIDE * SIDE, numbers // SIDE * SIDE
    if a.strides[1] != a.itemsize:
        of_rows = of_numbers = 0
    for number in range(0, of_numbers, SIDE):
        for column in range(0, of_rows, SIDE):
            transpose_block(a, (row + column, number), out, (number, column))
    for column in range(of_rows, rows):
        for number in range(of_numbers):
            out[number, column] = a[row + column, number]
    for number in range(of_numbers, numbers):
        for column in range(rows):
            out[number, column] = a[row + column, number]


@compiled(nogil=True)
def _multiply_columns(a: Float32s, b: Float32s, column: int, out: Float32s, to_column: int) -> None:
    """Multiply by WIDTH columns of ``b``, whose rows lie in one piece each."""
    rows = out.shape[0]
    if rows < ROWS:
        for row in range(rows):
            multiply_a_row(a, row, b, column, out, (row, to_column))
        return
    for row in range(0, rows, ROWS):
        at = min(row, rows - ROWS)  # the last tile may compute again what another has computed
        multiply_rows(a, at, b, column, out, (at, to_column))
