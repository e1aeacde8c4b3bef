import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.client.desktop.frames import Frames


def test_frames_are_counted_from_the_phase() -> None:
    frames = Frames(20.0, 0.01)
    assert frames.at_or_after(0.02) == pytest.approx(0.06)
    assert frames.at_or_before(0.02) == pytest.approx(0.01)
    assert frames.at_or_after(0.0) == pytest.approx(0.01)


def test_without_a_rate_there_is_a_frame_at_any_time() -> None:
    assert Frames(math.inf).at_or_after(1.2345) == Frames(math.inf).at_or_before(1.2345) == 1.2345


@given(st.floats(10.0, 240.0), st.floats(0.0, 0.1), st.integers(0, 10**6))
def test_a_frames_own_time_is_its_frame(fps: float, phase_s: float, count: int) -> None:
    frames = Frames(fps, phase_s)
    time_s = phase_s + count / fps
    assert frames.at_or_after(time_s) == frames.at_or_before(time_s) == time_s


@given(st.floats(10.0, 240.0), st.floats(0.0, 1e4))
def test_the_next_frame_is_less_than_a_frame_away(fps: float, time_s: float) -> None:
    frames = Frames(fps, 0.02)
    assert -1e-6 / fps <= frames.at_or_after(time_s) - time_s <= (1 + 1e-6) / fps
    assert -1e-6 / fps <= time_s - frames.at_or_before(time_s) <= (1 + 1e-6) / fps
