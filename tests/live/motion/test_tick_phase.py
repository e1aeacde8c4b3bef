"""TickPhase: found from sightings that are late by chance, and not found in a game without ticks."""

import random

import pytest

from mc_nested.live.motion.tick_phase import ENOUGH, TickPhase

TICK = 0.05


def _sightings(count: int, phase: float, seed: int) -> list[float]:
    """When steps are seen first: half a frame and 10 to 30 ms behind ticks."""
    rng = random.Random(seed)  # noqa: S311 - chance, not secrets
    return [
        100 + phase + TICK * rng.randrange(2000) + rng.uniform(0, 1 / 60) + rng.uniform(0.01, 0.03)
        for _ in range(count)
    ]


@pytest.mark.parametrize("phase", [0.0, 0.013, 0.031, 0.049])
@pytest.mark.parametrize("seed", range(5))
def test_ticks_are_known_to_a_few_milliseconds_after_some_steps(phase: float, seed: int) -> None:
    tick_phase = TickPhase()
    for seen in _sightings(40, phase, seed):
        tick_phase.saw_step(seen - 0.004, seen + 0.004)
    assert tick_phase.is_known
    off = (tick_phase.next(500.0) - phase + TICK / 2) % TICK - TICK / 2
    assert abs(off) < 0.008


def test_few_sightings_give_no_tick_phase() -> None:
    tick_phase = TickPhase()
    for seen in _sightings(int(ENOUGH) - 1, 0.01, 0):
        tick_phase.saw_step(seen, seen)
    assert not tick_phase.is_known


def test_a_game_without_ticks_has_no_phase() -> None:
    tick_phase, rng = TickPhase(), random.Random(1)  # noqa: S311
    for _ in range(60):
        seen = rng.uniform(0, 100)
        tick_phase.saw_step(seen, seen)
    assert not tick_phase.is_known


def test_the_next_tick_is_none_before() -> None:
    tick_phase = TickPhase()
    for seen in _sightings(20, 0.02, 2):
        tick_phase.saw_step(seen, seen)
    first = tick_phase.next(7.0, 0.0125)
    assert 7.0 <= first < 7.05
    assert tick_phase.next(first + 0.001, 0.0125) == pytest.approx(first + TICK)
