"""States as numbers, and the inputs that a network takes for each."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.dqn.states import StateSpace, one_hot, scaled


@given(st.lists(st.integers(0, 9), min_size=1, max_size=4), st.data())
def test_every_state_has_a_distinct_index(highest: list[int], data: st.DataObject) -> None:
    space = StateSpace(np.array([highest]), actions=2)
    states = [np.array([data.draw(st.integers(0, top)) for top in highest]) for _ in range(2)]
    one, other = (int(space.encoded(state)) for state in states)
    assert (one == other) == (states[0].tolist() == states[1].tolist())
    assert 0 <= min(one, other) <= max(one, other) < space.count == np.prod(np.array(highest) + 1)


def test_x_y_b_and_the_main_action_are_scaled_to_between_minus_one_and_one() -> None:
    highest = np.array([14, 14, 11, 1])
    assert scaled(np.array([0, 7, 11, 0]), highest).tolist() == [-1.0, 0.0, 1.0, -1.0, 1.0]
    assert scaled(np.array([14, 14, 0, 1]), highest).tolist() == [1.0, 1.0, -1.0, 1.0, 1.0]


def test_the_main_action_is_scaled_to_0_where_there_is_one_material() -> None:
    assert scaled(np.array([14, 0]), np.array([14, 0])).tolist() == [1.0, 0.0, 1.0]


def test_three_materials_are_scaled_to_minus_1_0_and_1() -> None:
    assert scaled(np.array([[0], [1], [2]]), np.array([2]))[:, 0].tolist() == [-1.0, 0.0, 1.0]


@pytest.mark.parametrize("rows", [[0, 1], [1, 0], [1]])
def test_each_row_is_scaled_by_its_own_scenario(rows: list[int]) -> None:
    blocks = np.array([11, 16])
    space = StateSpace(np.array([[14, 14, 11], [14, 14, 16]]), actions=8)
    states = space.encoded(np.array([[0, 14, blocks[row]] for row in rows]))
    features = space.table[states + space.first_of(np.array(rows))]
    assert features.tolist() == [[-1.0, 1.0, 1.0, 1.0]] * len(rows)
    for row, state in zip(rows, states, strict=True):
        assert space.features_of(row)[state].tolist() == [-1.0, 1.0, 1.0, 1.0]


def test_one_hot_gives_each_value_a_separate_input() -> None:
    assert one_hot(np.array([1, 0, 2]), np.array([2, 2, 3])).tolist() == [0, 1, 1, 0, 0, 0, 1, 1]


def test_one_hot_inputs_suffice_for_the_largest_of_several_scenarios() -> None:
    space = StateSpace(np.array([[14, 14, 11], [14, 14, 16]]), actions=8, encoding="one-hot")
    assert space.inputs == 15 + 15 + 17
    state = space.encoded(np.array([14, 0, 11]))
    for row in (0, 1):
        assert np.flatnonzero(space.features_of(row)[state]).tolist() == [14, 15, 30 + 11, 47]


def test_the_cell_encoding_has_an_input_for_each_cell_and_each_value_of_the_other_integers() -> None:
    space = StateSpace(np.array([[1, 2, 4, 1]]), actions=8, encoding="cell")
    # (x, y) = (1, 0) is the fourth of six cells; then b = 3 of five values, a_M = 0 of two, and the 1.
    state = space.encoded(np.array([1, 0, 3, 0]))
    assert space.features_of(0)[state].tolist() == [0, 0, 0, 1, 0, 0, *[0, 0, 0, 1, 0], *[1, 0], 1]


@pytest.mark.parametrize("encoding", ["scaled", "one-hot", "cell"])
def test_a_states_cell_part_and_rest_part_together_are_its_features(encoding: str) -> None:
    space = StateSpace(np.array([[4, 4, 3, 1], [6, 6, 5, 1]]), actions=8, encoding=encoding)
    for row in (0, 1):
        features, rest = space.features_of(row), space.rest_of(row)
        for state in (0, 17, space.count - 1):
            cell = space.parts.cells[space.first_of(np.array([row]))[0] // space.rest + state // space.rest]
            assert features[state].tolist() == [*cell, *rest[state % space.rest]]


def test_a_large_arena_with_many_blocks_takes_little_memory() -> None:
    space = StateSpace(np.array([[31, 31, 100, 1]]), actions=8, encoding="cell")
    assert space.parts.cells.nbytes + space.parts.rest.nbytes < 2**23
    assert space.inputs == 32 * 32 + 101 + 2


def test_a_states_index_combines_its_cell_and_the_rest_of_the_state() -> None:
    space = StateSpace(np.array([[3, 2, 4, 1]]), actions=8, encoding="cell")
    assert space.cells == 4 * 3
    assert space.inputs == 4 * 3 + 5 + 2
    assert space.strides.tolist() == [3 * 5 * 2, 5 * 2, 2, 1]
    state = np.array([2, 1, 3, 1])
    assert int(space.encoded(state)) == int(state @ space.strides)
    cell, rest = divmod(int(space.encoded(state)), space.count // space.cells)
    assert (cell, rest) == (2 * 3 + 1, 3 * 2 + 1)
    features = space.features_of(0)
    assert np.flatnonzero(features[space.encoded(state), : space.cells]).tolist() == [cell]
    # What follows the cell is the same for every cell: by the rest of the index.
    tails = features[:, space.cells :].reshape(space.cells, -1, 5 + 2 + 1)
    assert (tails == tails[0]).all()


@pytest.mark.parametrize("encoding", ["scaled", "one-hot", "cell"])
def test_every_encoding_tells_all_states_apart(encoding: str) -> None:
    space = StateSpace(np.array([[3, 2, 4, 1]]), actions=8, encoding=encoding)
    assert len(np.unique(space.table, axis=0)) == space.count == len(space.table)
    assert (space.table[:, -1] == 1.0).all()


def test_cell_inputs_suffice_for_the_largest_of_several_scenarios() -> None:
    space = StateSpace(np.array([[4, 4, 3], [6, 6, 5]]), actions=8, encoding="cell")
    assert space.inputs == 7 * 7 + 6
    state = space.encoded(np.array([4, 4, 3]))
    for row in (0, 1):
        assert np.flatnonzero(space.features_of(row)[state]).tolist() == [4 * 7 + 4, 49 + 3, 49 + 6]
