"""Values by the cell and the cells built: every name has its own row, which begins at 0 and stays."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.imagination.built_values import (
    FULL,
    BuiltValues,
    begin_values,
    empty_values,
    forget,
    is_full,
    row_of,
)

ROOM, ACTIONS, CELLS = 16, 3, 9
NAMES = st.lists(st.integers(1, 60), max_size=ROOM - 4, unique=True)


def begun(seed: int = 0) -> BuiltValues:
    table = empty_values(ROOM, ACTIONS, CELLS)
    begin_values(table, np.random.default_rng(seed))
    return table


@given(NAMES)
def test_every_name_keeps_a_separate_row(names: list[int]) -> None:
    table = begun()
    rows = [row_of(table, name) for name in names]
    assert len(set(rows)) == len(names) == table.held[0]
    assert [row_of(table, name) for name in names] == rows
    assert [int(table.names[row]) for row in rows] == names


def test_colliding_names_take_the_next_rows_and_wrap_around_the_end() -> None:
    table = begun()
    assert [row_of(table, name) for name in (15, 31, 47)] == [15, 0, 1]


def test_a_row_taken_after_forgetting_has_values_of_0() -> None:
    table = begun()
    table.values[row_of(table, 5)] = 7.0
    assert table.values[row_of(table, 5)].tolist() == [7.0] * ACTIONS
    forget(table)
    assert table.held[0] == 0
    assert table.values[row_of(table, 5)].tolist() == [0.0] * ACTIONS


def test_the_table_counts_as_full_before_every_row_is_in_use() -> None:
    table = begun()
    for name in range(1, int(FULL * ROOM) + 1):
        assert not is_full(table)
        row_of(table, name)
    assert not is_full(table)
    row_of(table, 60)
    assert is_full(table)


def test_random_bits_follow_the_seed_and_built_cells_make_one_name_in_any_order() -> None:
    one, same, other = begun(), begun(), begun(1)
    for bits in (one.here, one.built):
        assert len(np.unique(bits)) == CELLS
        assert (bits > 0).all()
    np.testing.assert_array_equal(one.built, same.built)
    assert (one.built != other.built).all()
    assert one.here[4] ^ one.built[1] ^ one.built[7] == one.here[4] ^ one.built[7] ^ one.built[1]
