"""A deadline: it has passed from its very moment on, and not before."""

from mc_nested.live.devices import Deadline
from tests.live.fake_game import FakeClock


def test_a_deadline_has_passed_from_its_moment_on() -> None:
    clock = FakeClock()
    deadline = Deadline(clock, 2.0)
    assert deadline.at == 102.0
    assert not deadline.has_passed
    clock.sleep_until(101.9)
    assert not deadline.has_passed
    clock.sleep_until(102.0)
    assert deadline.has_passed
