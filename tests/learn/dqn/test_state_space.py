"""States as numbers, and what a network takes for each."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.dqn.state_space import StateSpace, one_hot, scaled


@given(st.lists(st.integers(0, 9), min_size=1, max_size=4), st.data())
def test_every_state_has_a_number_of_its_own(highest: list[int], data: st.DataObject) -> None:
    space = StateSpace(np.array([highest]), actions=2)
    states = [np.array([data.draw(st.integers(0, top)) for top in highest]) for _ in range(2)]
    one, other = (int(space.index(state)) for state in states)
    assert (one == other) == (states[0].tolist() == states[1].tolist())
    assert 0 <= min(one, other) <= max(one, other) < space.count == np.prod(np.array(highest) + 1)


def test_x_y_b_are_scaled_to_one_around_zero_and_the_main_action_is_plus_or_minus_one() -> None:
    highest = np.array([14, 14, 11, 1])
    assert scaled(np.array([0, 7, 11, 0]), highest).tolist() == [-1.0, 0.0, 1.0, -1.0, 1.0]
    assert scaled(np.array([14, 14, 0, 1]), highest).tolist() == [1.0, 1.0, -1.0, 1.0, 1.0]


def test_the_choice_of_a_single_material_says_nothing() -> None:
    assert scaled(np.array([14, 0]), np.array([14, 0])).tolist() == [1.0, 0.0, 1.0]


def test_three_materials_lie_on_one_dimension() -> None:
    assert scaled(np.array([[0], [1], [2]]), np.array([2]))[:, 0].tolist() == [-1.0, 0.0, 1.0]


@pytest.mark.parametrize("rows", [[0, 1], [1, 0], [1]])
def test_each_row_is_scaled_by_its_own_scenario(rows: list[int]) -> None:
    blocks = np.array([11, 16])
    space = StateSpace(np.array([[14, 14, 11], [14, 14, 16]]), actions=8)
    states = space.index(np.array([[0, 14, blocks[row]] for row in rows]))
    features = space.table[states + space.first_of(np.array(rows))]
    assert features.tolist() == [[-1.0, 1.0, 1.0, 1.0]] * len(rows)
    for row, state in zip(rows, states, strict=True):
        assert space.features_of(row)[state].tolist() == [-1.0, 1.0, 1.0, 1.0]


def test_one_hot_gives_each_value_an_input_of_its_own() -> None:
    assert one_hot(np.array([1, 0, 2]), np.array([2, 2, 3])).tolist() == [0, 1, 1, 0, 0, 0, 1, 1]


def test_one_hot_networks_of_other_scenarios_have_inputs_enough_for_all() -> None:
    space = StateSpace(np.array([[14, 14, 11], [14, 14, 16]]), actions=8, encoding="one-hot")
    assert space.inputs == 15 + 15 + 17
    state = space.index(np.array([14, 0, 11]))
    for row in (0, 1):
        assert np.flatnonzero(space.features_of(row)[state]).tolist() == [14, 15, 30 + 11, 47]
