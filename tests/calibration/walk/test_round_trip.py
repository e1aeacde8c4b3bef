"""The round trip from a key to the screen, estimated from holds with known times."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.walk.round_trip import HoldTiming, disagreeing, latencies, round_trip_of
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, INPUT_LATENCY_S

FRAME_S = 1 / 60


def hold(
    pressed: float, held_s: float, felt_s: float, seen_s: float, rng: np.random.Generator | None = None
) -> HoldTiming:
    """Return a hold in a game with ticks at multiples of 50 ms; with ``rng`` every event is late by its own amount."""

    def late(most: float) -> float:
        return rng.uniform(-most, most) if rng else 0.0

    first = math.ceil((pressed + felt_s + late(0.007)) / TICK_S)
    behind = math.ceil((pressed + held_s + felt_s + late(0.007)) / TICK_S)
    shown = [(tick, (first + tick - 1) * TICK_S + seen_s + late(0.008)) for tick in range(1, behind - first + 5)]
    seen = tuple((tick, at - FRAME_S / 2, at + FRAME_S / 2) for tick, at in shown)
    return HoldTiming(pressed, pressed + held_s, behind - first, seen)


@given(st.floats(0.002, 0.06), st.floats(0.01, 0.09))
def test_round_trip_is_the_sum_of_input_and_capture_latency(felt_s: float, seen_s: float) -> None:
    holds = [hold(100 + index * 0.831, 0.2 + index % 5 * 0.037, felt_s, seen_s) for index in range(60)]
    assert round_trip_of(holds) == pytest.approx(felt_s + seen_s, abs=0.002)


def test_jitter_of_every_event_moves_the_round_trip_by_at_most_4_ms() -> None:
    rng = np.random.default_rng(5)
    holds = [hold(100 + index * 0.831, 0.2 + index % 5 * 0.037, 0.0125, 0.028, rng) for index in range(60)]
    assert round_trip_of(holds) == pytest.approx(0.0405, abs=0.004)


HOLDS = [hold(100 + index * 0.831, 0.2 + index % 5 * 0.037, 0.0125, 0.028) for index in range(60)]
LAGGED = [hold(200 + index * 0.831, 0.25, 0.3, 0.2) for index in range(4)]


def test_few_lagging_holds_move_the_round_trip_by_at_most_4_ms() -> None:
    assert round_trip_of([*HOLDS, *LAGGED]) == pytest.approx(0.0405, abs=0.004)


def test_few_key_edges_disagree_if_a_game_stalls_at_times_and_many_if_frames_are_slow() -> None:
    assert disagreeing(HOLDS, 0.0405) == 0.0
    # 8 ms more: edges of 40.5 to 44.5 ms out of 40.5 to 90.5 don't fit.
    assert disagreeing(HOLDS, 0.0485) == pytest.approx(4 / 50, abs=0.03)
    assert disagreeing([*HOLDS, *LAGGED], 0.0405) == pytest.approx(4 / 64)
    # A key waits for one of ten frames a second, and its tick is seen in the next one.
    slow = [
        HoldTiming(at, at + 0.25, 5, ((1, at + delay, at + delay),))
        for index in range(50)
        for at, delay in [(100 + index * 0.831, 0.028 + index * 0.002)]
    ]
    assert disagreeing(slow, round_trip_of(slow)) > 0.3


def test_steps_off_their_holds_tick_phase_count_as_late() -> None:
    steady = hold(100.0, 0.3, 0.0125, 0.028)
    assert steady.late_steps == 0
    moved = tuple((tick, since + 0.06 * (tick > 7), at + 0.06 * (tick > 7)) for tick, since, at in steady.steps)
    assert (
        HoldTiming(steady.pressed, steady.released, steady.ticks, moved).late_steps
        == sum(tick > 7 for tick, _, _ in moved)
        > 0
    )


def test_a_round_trip_is_split_in_the_ratio_of_the_default_latencies() -> None:
    assert latencies(INPUT_LATENCY_S + CAPTURE_LATENCY_S) == pytest.approx((INPUT_LATENCY_S, CAPTURE_LATENCY_S))
    felt, seen = latencies(0.1)
    assert felt + seen == pytest.approx(0.1)
