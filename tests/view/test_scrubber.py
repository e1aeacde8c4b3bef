from hypothesis import given
from hypothesis import strategies as st

from mc_nested.view.scrubber import Scrubber
from tests.view.shown import LIVE

HISTORY = [LIVE.model_copy(update={"at": float(number)}) for number in range(41)]


def test_it_moves_by_a_moment_and_by_a_tenth() -> None:
    past = Scrubber(HISTORY, 20)

    assert past.moved(-1).status.at == 19
    assert past.moved(1).status.at == 21
    assert past.jumped(-1).status.at == 16
    assert past.jumped(2).status.at == 28


@given(st.lists(st.integers(-100, 100)))
def test_it_stops_at_both_ends(moves: list[int]) -> None:
    past = Scrubber(HISTORY, 20)
    for move in moves:
        past = past.moved(move)
        assert past.status in HISTORY


def test_its_line_has_a_mark_where_it_is_and_the_times_of_its_ends() -> None:
    assert Scrubber(HISTORY, 0).line(29).plain == "00:00:00 ●────────── 00:00:40"
    assert Scrubber(HISTORY, 20).line(29).plain == "00:00:00 ━━━━━●───── 00:00:40"
    assert Scrubber(HISTORY, 40).line(29).plain == "00:00:00 ━━━━━━━━━━● 00:00:40"


def test_a_history_of_one_moment_has_a_line_too() -> None:
    assert Scrubber(HISTORY[:1], 0).line(25).plain == "00:00:00 ●────── 00:00:00"
