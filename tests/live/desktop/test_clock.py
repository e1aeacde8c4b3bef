"""The real clock."""

from mc_nested.live.desktop.clock import SPIN_S, MonotonicClock


def test_a_wait_ends_at_its_time_and_never_before() -> None:
    clock = MonotonicClock()
    at = clock.now() + 0.005
    clock.sleep_until(at)
    assert at <= clock.now() < at + 0.5
    clock.sleep_until(at - 10)
    assert clock.now() < at + 0.5


def test_a_long_wait_sleeps_and_still_ends_at_its_time() -> None:
    clock = MonotonicClock()
    until = clock.now() + 3 * SPIN_S
    clock.sleep_until(until)
    assert until <= clock.now() < until + 0.5
