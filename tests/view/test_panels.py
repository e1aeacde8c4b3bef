import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.view.panels import WIDEST, curve_panel, side_panel
from mc_nested.view.status import ReadingSeen
from tests.view.shown import LIVE


def test_where_the_time_of_actions_goes_stands_above_them_where_three_still_fit() -> None:
    played = LIVE.model_copy(
        update={"share": "walking 90 %, confirming 8 %, deciding 2 %", "learning": None, "reading": None}
    )
    played = played.model_copy(update={"actions": LIVE.actions[:1] * 4, "lines": ()})
    heading, share, *actions = side_panel(played, 60, 5).plain.split("\n")
    assert (heading, share, len(actions)) == ("last actions: time, where to, block", played.share, 3)
    assert played.share not in side_panel(played, 60, 4).plain


def test_the_side_panel_shows_everything_where_there_is_room() -> None:
    assert [line.rstrip() for line in side_panel(LIVE, 60, 21).plain.split("\n")] == [
        "12 of at most 41 episodes",
        "last score 18, best 24, of 26",
        "probing, 9 of 16 cells known",
        "game time left: about 5 min 30 s",
        "score by episode, from 0 to 26",
        "",
        "",
        "            ▄▄▄",
        "            ███",
        "      ▁▁▁██████",
        "      █████████",
        "   ▇▇▇█████████",
        "▅▅▅████████████",
        "the debug screen",
        "at 10.500 64.000 -7.500  0.0 / 45.0",
        "looks at minecraft:stone at 10 64 -6",
        "last actions: time, where to, block",
        "412 ms R+D (2, 1), block (2, 2)",
        "298 ms F   (1, 1)",
        "it said",
        "Switch to the game now with Alt+Tab.",
    ]


@pytest.mark.parametrize("height", range(1, 30))
def test_the_side_panel_never_exceeds_its_lines(height: int) -> None:
    assert len(side_panel(LIVE, 30, height).split("\n")) <= height


def test_an_instruction_is_wrapped_and_not_cut_off() -> None:
    narrow = side_panel(LIVE, 20, 40).plain.split("\n")

    assert narrow[-2:] == ["Switch to the game", "now with Alt+Tab."]


def test_side_panel_says_why_the_screen_cannot_be_read() -> None:
    blind = LIVE.model_copy(update={"reading": ReadingSeen(problem="the chat covers the line XYZ")})

    assert "the chat covers the line XYZ" in side_panel(blind, 60, 30).plain


def test_a_score_is_drawn_in_eighths_of_a_line() -> None:
    assert curve_panel([0.0, 1.0, 8.0, 16.0], 16.0, 4, 2).plain.split("\n") == [
        "   █",
        " ▁██",
    ]


def test_few_scores_are_drawn_wider() -> None:
    assert curve_panel([8.0], 8.0, 20, 1).plain == "█" * WIDEST


def test_more_scores_than_columns_are_drawn_as_means() -> None:
    assert curve_panel([0.0, 8.0, 8.0, 8.0], 8.0, 2, 1).plain == "▄█"


def test_without_scores_no_curve_is_drawn() -> None:
    assert curve_panel([], 8.0, 20, 3).plain == ""
    assert curve_panel([1.0], 8.0, 0, 3).plain == ""
    assert curve_panel([1.0], 8.0, 20, 0).plain == ""


@given(
    st.lists(st.floats(-1e3, 1e3), min_size=1, max_size=300),
    st.floats(0, 100),
    st.integers(1, 90),
    st.integers(1, 8),
)
def test_the_curve_fits_its_panel(scores: list[float], highest: float, width: int, height: int) -> None:
    lines = curve_panel(scores, highest, width, height).plain.split("\n")

    assert len(lines) == height
    assert np.ptp([len(line) for line in lines]) == 0
    assert len(lines[0]) <= width
