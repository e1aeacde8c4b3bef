"""Prioritized replay: draws in proportion, weights that correct the bias, and sums that always add up."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.learn.dqn.prioritized import SMALLEST_ERROR, Priorities

ROW = np.array([0])


def priorities_of(errors: list[float], alpha: float = 1.0, beta: float = 1.0, room: int = 4) -> Priorities:
    """Return the priorities of one run whose transitions have these TD errors."""
    priorities = Priorities(runs=1, room=room, alpha=alpha, beta=beta)
    for place in range(len(errors)):
        priorities.add(ROW, np.array([place]))
    priorities.update_priorities(ROW, np.arange(len(errors))[None], np.array([errors], np.float32))
    return priorities


def counts(priorities: Priorities, kinds: int) -> list[int]:
    """Return how often each index is drawn in 1,000 evenly spread draws."""
    drawn = priorities.sample(ROW, np.full((1, 1000), 0.5))
    return [int(count) for count in np.bincount(drawn[0], minlength=kinds)]


def test_transitions_are_drawn_in_proportion_to_their_td_errors() -> None:
    assert counts(priorities_of([1.0, 3.0, 0.0, 6.0]), 4) == pytest.approx([100, 300, 0, 600], abs=1)


def test_priorities_are_split_evenly_among_the_draws_that_are_not_replaced() -> None:
    priorities = priorities_of([1.0] * 4)
    drawn = priorities.sample(np.array([0, 0]), np.full((2, 6), 0.5), np.array([2, 0]))
    assert drawn[0, 2:].tolist() == [0, 1, 2, 3]
    assert drawn[1].tolist() == priorities.sample(ROW, np.full((1, 6), 0.5))[0].tolist()


def test_alpha_is_the_exponent_of_priorities_and_0_draws_uniformly() -> None:
    assert counts(priorities_of([1.0, 16.0], alpha=0.5), 2) == pytest.approx([200, 800], abs=1)
    assert counts(priorities_of([1.0, 16.0], alpha=0.0), 2) == [500, 500]


def test_a_new_transition_has_the_highest_priority_seen() -> None:
    priorities = priorities_of([1.0, 3.0])
    priorities.add(ROW, np.array([2]))
    assert counts(priorities, 3) == pytest.approx([1000 / 7, 3000 / 7, 3000 / 7], abs=2)


def test_importance_weights_are_inverse_shares_scaled_by_the_batchs_largest_weight() -> None:
    # Shares 1/4 and 3/4 of two transitions: (2 · 1/4)⁻¹ = 2 and (2 · 3/4)⁻¹ = 2/3, a third of it.
    weights = priorities_of([1.0, 3.0]).weights(ROW, np.array([[0, 1]]), np.array([2]))
    assert weights.tolist() == [[1.0, pytest.approx(1 / 3, rel=0.01)]]
    none_back = priorities_of([1.0, 3.0], beta=0.0).weights(ROW, np.array([[0, 1]]), np.array([2]))
    assert none_back.tolist() == [[1.0, 1.0]]


@given(st.lists(st.floats(0, 10), min_size=1, max_size=40), st.floats(0, 1, exclude_max=True))
def test_only_stored_transitions_are_drawn_after_the_memory_has_grown(errors: list[float], number: float) -> None:
    priorities = priorities_of(errors, room=2)
    drawn = priorities.sample(ROW, np.full((1, 7), number))
    assert drawn.min() >= 0
    assert drawn.max() < len(errors)
    leaves = priorities.state()["leaves"][0]
    np.testing.assert_allclose(leaves[: len(errors)], np.array(errors, np.float32) + SMALLEST_ERROR, rtol=1e-6)
    assert not leaves[len(errors) :].any()


def test_each_run_draws_by_its_own_priorities() -> None:
    priorities = Priorities(runs=2, room=4, alpha=1.0, beta=1.0)
    priorities.add(np.array([0, 1]), np.array([0, 0]))
    priorities.add(np.array([1]), np.array([1]))
    priorities.update_priorities(np.array([1]), np.array([[0, 1]]), np.array([[0.0, 5.0]], np.float32))
    assert priorities.sample(np.array([0, 1]), np.full((2, 3), 0.5)).tolist() == [[0, 0, 0], [1, 1, 1]]


def test_loaded_priorities_draw_the_same_transitions() -> None:
    one, other = priorities_of([1.0, 2.0, 3.0, 4.0, 5.0]), Priorities(1, 2, 1.0, 1.0)
    other.load({name: kept.copy() for name, kept in one.state().items()})
    assert counts(other, 5) == counts(one, 5)
    for each in (one, other):
        each.add(ROW, np.array([5]))
    assert counts(other, 6) == counts(one, 6)
