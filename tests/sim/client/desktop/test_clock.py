import math
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.client.desktop.clock import Frames, VirtualClock


def test_planned_events_happen_at_their_times_and_in_order() -> None:
    clock = VirtualClock(10.0)
    seen: list[tuple[str, float]] = []

    def note(name: str) -> None:
        seen.append((name, clock.now()))

    for name, at in (("late", 13.0), ("second", 12.0), ("first", 11.0), ("third", 12.0)):
        clock.call_at(at, partial(note, name))
    clock.sleep_until(12.5)
    assert seen == [("first", 11.0), ("second", 12.0), ("third", 12.0)]
    assert clock.now() == 12.5
    clock.sleep(0.5)
    assert seen[-1] == ("late", 13.0)


def test_an_event_can_plan_another_within_the_same_sleep() -> None:
    clock = VirtualClock(0.0)
    ticks: list[float] = []

    def tick() -> None:
        ticks.append(clock.now())
        clock.call_at(clock.now() + 1, tick)

    clock.call_at(0.5, tick)
    clock.sleep_until(3.0)
    assert ticks == [0.5, 1.5, 2.5]


def test_time_never_goes_back() -> None:
    clock = VirtualClock(5.0)
    happened: list[float] = []
    clock.call_at(1.0, lambda: happened.append(clock.now()))
    clock.sleep_until(2.0)
    assert clock.now() == 5.0
    assert happened == [5.0]


def test_frames_are_counted_from_the_phase() -> None:
    frames = Frames(20.0, 0.01)
    assert frames.at_or_after(0.02) == pytest.approx(0.06)
    assert frames.at_or_before(0.02) == pytest.approx(0.01)
    assert frames.at_or_after(0.0) == pytest.approx(0.01)


def test_an_infinite_frame_rate_has_a_frame_at_any_time() -> None:
    assert Frames(math.inf).at_or_after(1.2345) == Frames(math.inf).at_or_before(1.2345) == 1.2345


@given(st.floats(10.0, 240.0), st.floats(0.0, 0.1), st.integers(0, 10**6))
def test_the_frame_at_a_frames_own_time_is_that_frame(fps: float, phase_s: float, count: int) -> None:
    frames = Frames(fps, phase_s)
    time_s = phase_s + count / fps
    assert frames.at_or_after(time_s) == frames.at_or_before(time_s) == time_s


@given(st.floats(10.0, 240.0), st.floats(0.0, 1e4))
def test_the_next_frame_is_less_than_a_frame_away(fps: float, time_s: float) -> None:
    frames = Frames(fps, 0.02)
    assert -1e-6 / fps <= frames.at_or_after(time_s) - time_s <= (1 + 1e-6) / fps
    assert -1e-6 / fps <= time_s - frames.at_or_before(time_s) <= (1 + 1e-6) / fps
