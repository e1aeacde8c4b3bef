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
def test_a_step_is_surely_seen_half_a_tick_after_the_latency(latency_s: float) -> None:
    assert surely_seen_after(latency_s) - latency_s == pytest.approx(TICK_S / 2)


def test_a_frame_lasts_two_half_frames_and_three_third_frames() -> None:
    assert HALF_FRAME_S * 2 == FRAME_S < TICK_S
    assert pytest.approx(FRAME_S) == THIRD_FRAME_S * 3


def test_fast_looks_are_never_skipped_as_looks_at_the_same_frame() -> None:
    assert THIRD_FRAME_S > SAME_FRAME_S


def test_early_looks_for_a_step_begin_less_than_half_a_tick_before_it() -> None:
    assert EARLY_LOOK_S < TICK_S / 2
