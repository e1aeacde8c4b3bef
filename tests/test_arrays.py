"""The parts of a saved state are distinguished by their names alone."""

import numpy as np

from mc_nested.arrays import named_for, part_of

ONE, TWO = np.array([1]), np.array([2])


def test_a_part_of_a_state_is_found_under_its_own_names() -> None:
    state = {"main.x": ONE, "nested.main.x": TWO, "maintain": np.array([3])}
    assert part_of(state, "main") == {"x": ONE}


def test_parts_within_parts_are_found_again() -> None:
    state = named_for("agent", named_for("main", {"x": ONE}) | named_for("low", {"x": TWO}))
    assert list(state) == ["agent.main.x", "agent.low.x"]
    assert part_of(part_of(state, "agent"), "low") == {"x": TWO}
