"""Standstill: believed at once after a coasting tail, and only slowly where the picture may have stalled."""

from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.motion.standstill import STALL_S, Standstill

SETTLE_S = 0.15


def _walked(ticks: int) -> list[float]:
    """Where a walker is after each tick of a hold and of the coasting after it (FACTS: Walking)."""
    places, place, speed = [], 0.0, 0.0
    for tick in range(ticks + 12):
        speed = (speed if speed >= 0.003 else 0.0) + (0.098 if tick < ticks else 0.0)
        place += speed
        speed *= 0.546
        places.append(round(place, 3))
    return places


def _seconds_until_reached(places: list[float], tick_s: float = 0.05) -> float:
    """Seconds from the first position until standstill, with the last position staying."""
    standstill = Standstill((0.0, 0.0), 0.0, SETTLE_S)
    for look in range(1000):
        place = places[min(int(look * 0.01 / tick_s), len(places) - 1)]
        if standstill.is_reached((0.0, place), look * 0.01):
            return look * 0.01
    raise AssertionError("never stood")


@given(st.integers(1, 12))
def test_after_a_walk_it_comes_soon_after_the_last_step(ticks: int) -> None:
    places = _walked(ticks)
    last_step_s = places.index(places[-1]) * 0.05
    assert last_step_s + SETTLE_S <= _seconds_until_reached(places) <= last_step_s + SETTLE_S + 0.02


@given(st.integers(2, 6), st.data(), st.floats(0.16, 0.9))
def test_a_stall_while_the_key_is_still_felt_is_waited_out(ticks: int, data: st.DataObject, stall_s: float) -> None:
    places = _walked(ticks)
    stalled = data.draw(st.integers(0, ticks - 1))
    late = places[:stalled] + [places[stalled]] * round(stall_s / 0.05) + places[stalled:]
    assert _seconds_until_reached(late) >= late.index(places[-1]) * 0.05 + SETTLE_S


def test_a_game_that_answers_late_is_waited_for() -> None:
    late = [0.0] * 10 + _walked(5)
    assert _seconds_until_reached(late) >= late.index(late[-1]) * 0.05


def test_a_walker_that_never_moved_stands_still_after_a_while() -> None:
    assert STALL_S <= _seconds_until_reached([0.0]) <= STALL_S + 0.02
