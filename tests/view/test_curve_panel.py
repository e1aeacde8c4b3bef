import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.view.curve_panel import WIDEST, curve_panel


def test_a_score_is_drawn_in_eighths_of_a_line() -> None:
    assert curve_panel([0.0, 1.0, 8.0, 16.0], 16.0, 4, 2).plain.split("\n") == [
        "   █",
        " ▁██",
    ]


def test_few_scores_are_drawn_wider() -> None:
    assert curve_panel([8.0], 8.0, 20, 1).plain == "█" * WIDEST


def test_more_scores_than_columns_are_drawn_as_means() -> None:
    assert curve_panel([0.0, 8.0, 8.0, 8.0], 8.0, 2, 1).plain == "▄█"


def test_nothing_is_drawn_of_nothing() -> None:
    assert curve_panel([], 8.0, 20, 3).plain == ""
    assert curve_panel([1.0], 8.0, 0, 3).plain == ""
    assert curve_panel([1.0], 8.0, 20, 0).plain == ""


@given(
    st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=300),
    st.floats(0, 100),
    st.integers(1, 90),
    st.integers(1, 8),
)
def test_it_fits(scores: list[float], highest: float, width: int, height: int) -> None:
    lines = curve_panel(scores, highest, width, height).plain.split("\n")

    assert len(lines) == height
    assert np.ptp([len(line) for line in lines]) == 0
    assert len(lines[0]) <= width
