import numpy as np
import pytest

from scripts.bench_screen import in_view, measure, share_alike, square_of, walk


def test_a_look_that_two_states_have_is_alike_however_often_it_comes() -> None:
    looks = [("a", (0, 0, 5)), ("a", (1, 0, 5)), ("b", (2, 0, 5)), ("b", (2, 0, 5))]
    assert share_alike(looks) == 0.5


def test_straight_down_a_block_ahead_and_two_beside_are_in_view() -> None:
    # From 1.62 blocks up, 35 degrees are 1.13 blocks, and 854 / 480 times as far to each side.
    # In a row of five that is 3, 4, 5, 4, 3 columns; in the first row two rows of them, in the second three.
    assert in_view(5, 90.0)[:2] == [round(19 * 2 / 125, 3), round(19 * 3 / 125, 3)]


def test_a_walk_begins_anew_at_its_limit_and_stays_inside() -> None:
    scenario = square_of(5)
    steps = list(walk(scenario, 100, np.random.default_rng(0)))
    assert [begins for _, _, begins in steps].count(True) >= 4
    assert all(cell == scenario.start and not placed for cell, placed, begins in steps if begins)
    assert all(0 <= x < 5 and 0 <= y < 5 for (x, y), _, _ in steps)


@pytest.mark.slow
def test_more_looks_different_where_the_agent_looks_further_ahead() -> None:
    down, ahead = (measure(5, pitch, 300, 0) for pitch in (65.0, 53.0))
    assert down["cells_seen"] < ahead["cells_seen"] == 25
    assert ahead["alike_4"] < down["alike_4"]
