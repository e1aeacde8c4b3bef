"""The parts of a saved state are distinguished by their names alone."""

import numpy as np

from mc_nested.arrays import named_for, part_of

ONE, TWO = np.array([1]), np.array([2])


def test_part_of_returns_only_arrays_under_the_exact_prefix() -> None:
    state = {"main.x": ONE, "nested.main.x": TWO, "maintain": np.array([3])}
    assert part_of(state, "main") == {"x": ONE}


def test_part_of_finds_parts_nested_within_parts() -> None:
    state = named_for("agent", named_for("main", {"x": ONE}) | named_for("low", {"x": TWO}))
    assert list(state) == ["agent.main.x", "agent.low.x"]
    assert part_of(part_of(state, "agent"), "low") == {"x": TWO}
