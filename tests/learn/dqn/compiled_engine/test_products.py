"""Matrix products of any small shape, against numpy's in 64 bits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON
from mc_nested.learn.dqn.compiled_engine.products import multiply
from mc_nested.learn.dqn.compiled_engine.vectors import (
    LANES,
    ROWS,
    SIDE,
    WIDTH,
    multiply_rows,
    sum_in_lanes,
    transpose_block,
)

GUARD = np.float32(-7)
SIZES = st.integers(2, 40)


def product(a: Float32s, b: Float32s) -> Float32s:
    """Return the product of both matrices, and check that nothing is written beside it.

    All three are parts of larger arrays: compiled once for all that lie so, and in seconds for each other layout.
    """
    wide = np.full((len(a), b.shape[1] + 2), GUARD, np.float32)
    multiply(part(a), part(b), wide[:, 1:-1])
    np.testing.assert_array_equal(wide[:, [0, -1]], GUARD)
    return np.ascontiguousarray(wide[:, 1:-1])


def part(matrix: Float32s) -> Float32s:
    """Return the matrix, in its own memory layout, as a part of a larger one.

    The rest is not to be read.
    """
    if matrix.flags.f_contiguous:
        turned: Float32s = part(matrix.T).T
        return turned
    larger = np.full((len(matrix) + 2, matrix.shape[1] + 2), np.nan, np.float32)
    found: Float32s = larger[1:-1, 1:-1]
    found[:] = matrix
    return found


@pytest.mark.parametrize("shape", [(1, 20, 33), (9, 1, 33), (9, 20, 1), (1, 1, 1)], ids=str)
def test_multiply_takes_matrices_of_one_row_one_term_or_one_column(shape: tuple[int, int, int]) -> None:
    rows, terms, columns = shape
    random = np.random.default_rng(1)
    a, b = (random.standard_normal(each).astype(np.float32) for each in ((rows, terms), (terms, columns)))
    found = np.full((rows, columns), GUARD, np.float32)
    multiply(a, b, found)
    np.testing.assert_allclose(found, a.astype(np.float64) @ b, rtol=0, atol=2e-5)


@given(SIZES, SIZES, SIZES, st.booleans(), st.booleans())
def test_multiply_gives_the_product_for_any_shape_and_memory_layout(
    rows: int, terms: int, columns: int, a_turned: bool, b_turned: bool
) -> None:
    random = np.random.default_rng([rows, terms, columns])
    a = random.standard_normal((terms, rows)).T if a_turned else random.standard_normal((rows, terms))
    b = random.standard_normal((columns, terms)).T if b_turned else random.standard_normal((terms, columns))
    found = product(a.astype(np.float32), b.astype(np.float32))
    np.testing.assert_allclose(found, a @ b, rtol=0, atol=2e-5)


def test_multiply_takes_parts_of_larger_matrices() -> None:
    random = np.random.default_rng(0)
    a, b = (random.standard_normal((50, 50)).astype(np.float32) for _ in range(2))
    expected = a[3:12, 5:25].astype(np.float64) @ b[7:27, 1:34].astype(np.float64)
    np.testing.assert_allclose(product(a[3:12, 5:25], b[7:27, 1:34]), expected, rtol=0, atol=2e-5)


@pytest.mark.skipif(not IN_PYTHON, reason="compiled code checks no bounds")
@pytest.mark.parametrize(("row", "column", "to"), [(1, 0, (0, 0)), (0, 1, (0, 0)), (0, 0, (1, 0)), (0, 0, (0, 1))])
def test_multiplying_a_tile_beyond_a_matrix_raises_in_plain_python(row: int, column: int, to: tuple[int, int]) -> None:
    a, b, out = (np.zeros(shape, np.float32) for shape in ((ROWS, 2), (2, WIDTH), (ROWS, WIDTH)))
    multiply_rows(a, 0, b, 0, out, (0, 0))
    with pytest.raises(IndexError):
        multiply_rows(a, row, b, column, out, to)


@pytest.mark.skipif(not IN_PYTHON, reason="compiled code checks no bounds")
@pytest.mark.parametrize(("at", "to"), [((1, 0), (0, 0)), ((0, 1), (0, 0)), ((0, 0), (1, 0)), ((0, 0), (0, 1))])
def test_transposing_a_block_beyond_a_matrix_raises_in_plain_python(at: tuple[int, int], to: tuple[int, int]) -> None:
    matrix = np.arange(SIDE * SIDE, dtype=np.float32).reshape(SIDE, SIDE)
    turned = np.zeros_like(matrix)
    transpose_block(matrix, (0, 0), turned, (0, 0))
    assert (turned == matrix.T).all()
    with pytest.raises(IndexError):
        transpose_block(matrix, at, turned, to)


@pytest.mark.skipif(not IN_PYTHON, reason="compiled code checks no bounds")
def test_summing_beyond_a_row_raises_in_plain_python() -> None:
    ones = np.ones((1, LANES), np.float32)
    assert sum_in_lanes(ones, 0, ones, LANES) == LANES
    with pytest.raises(IndexError):
        sum_in_lanes(ones, 0, ones, 2 * LANES)
    with pytest.raises(IndexError):
        sum_in_lanes(ones, 1, ones, LANES)
