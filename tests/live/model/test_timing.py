"""Timing: what follows from a latency, and how often things are looked at."""

import pytest

from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import (
    CAPTURE_LATENCY_S,
    EARLY_LOOK_S,
    FRAME_S,
    HALF_FRAME_S,
    SAME_FRAME_S,
    THIRD_FRAME_S,
    surely_seen_after,
)


@pytest.mark.parametrize("latency_s", [0.0, CAPTURE_LATENCY_S, 0.075])
def test_a_step_is_surely_seen_half_way_to_when_the_next_one_may_be(latency_s: float) -> None:
    assert surely_seen_after(latency_s) - latency_s == pytest.approx(TICK_S / 2)


def test_two_or_three_looks_come_in_a_frame() -> None:
    assert HALF_FRAME_S * 2 == FRAME_S < TICK_S
    assert pytest.approx(FRAME_S) == THIRD_FRAME_S * 3


def test_fast_looks_are_never_skipped_as_looks_at_the_same_frame() -> None:
    assert THIRD_FRAME_S > SAME_FRAME_S


def test_looks_for_a_step_do_not_begin_while_the_one_before_may_be_unseen() -> None:
    assert EARLY_LOOK_S < TICK_S / 2
