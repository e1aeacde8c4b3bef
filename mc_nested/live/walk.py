"""How far a key held for so many ticks walks (FACTS: Walking), and which hold ends nearest a wish."""

from collections.abc import Sequence

TICK_S = 0.05
"""Seconds of a game tick (FACTS: Walking)."""

_INPUT = 0.98
_INERTIA = 0.6 * 0.91
_ACCELERATION = 0.1 * 0.1627714 / _INERTIA**3
_STANDSTILL = 0.003


def displacement(ticks: int) -> float:
    """Blocks covered by holding a direction for ``ticks`` ticks from rest on stone, then coasting to a stop."""
    covered = velocity = 0.0
    held = 0
    while held < ticks or velocity >= _STANDSTILL:
        if held < ticks:
            velocity += _INPUT * _ACCELERATION
            held += 1
        covered += velocity
        velocity *= _INERTIA
    return covered


def walk_response(longest: int) -> tuple[float, ...]:
    """Blocks covered for 1, 2 ... ``longest`` ticks held, walking."""
    return tuple(displacement(ticks) for ticks in range(1, longest + 1))


def nearest_ticks(distance: float, response: Sequence[float]) -> int:
    """The hold, in ticks, that ends nearest ``distance`` blocks away; 0 where standing still is nearest.

    ``response[n - 1]`` is the distance that ``n`` ticks cover; a longer way than the last takes the last.
    """
    ends = [0.0, *response]
    return min(range(len(ends)), key=lambda ticks: abs(ends[ticks] - distance))
