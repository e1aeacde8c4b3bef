"""How far a key held for so many ticks walks (FACTS: Walking), and which hold ends nearest a wish."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

TICK_S = 0.05
"""Seconds of a game tick (FACTS: Walking)."""

INERTIA = 0.6 * 0.91
"""What a tick leaves of a step, on stone."""

STANDSTILL = 0.003
"""Blocks a tick: a slower walker stands."""

SNEAKING = 0.3
"""What sneaking leaves of a push."""

PUSH = 0.98 * 0.1 * 0.1627714 / INERTIA**3
"""Blocks that a tick of a held key adds to a step, walking."""

Gait = Literal["walk", "sneak"]


@dataclass(frozen=True)
class Steps:
    """How to hold a key: the gait, and the ticks."""

    gait: Gait
    ticks: int


def displacement(ticks: int, inertia: float = INERTIA) -> float:
    """Blocks covered by holding a direction for ``ticks`` ticks from rest, a push as on stone, then coasting."""
    covered = velocity = 0.0
    held = 0
    while held < ticks or velocity >= STANDSTILL:
        if held < ticks:
            velocity += PUSH
            held += 1
        covered += velocity
        velocity *= inertia
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


def push_of(response: Sequence[float], inertia: float = INERTIA) -> float:
    """Blocks that a tick of a held key adds to a step, for a walker who covers as much as ``response`` says."""
    return PUSH * response[-1] / displacement(len(response), inertia)


def best_steps(distance: float, response: Sequence[float], tolerance: float, slower: float = SNEAKING) -> Steps:
    """The walk that ends nearest; where even that ends outside the tolerance, walking or sneaking, whichever is nearer.

    Sneaking covers ``slower`` times as much. One tick at least: whoever has to move must not wait for a smaller step
    than there is.
    """
    walking = max(1, nearest_ticks(distance, response))
    missed = abs(response[walking - 1] - distance)
    if missed <= tolerance:
        return Steps("walk", walking)
    slow = [slower * covered for covered in response]
    sneaking = max(1, nearest_ticks(distance, slow))
    nearer = abs(slow[sneaking - 1] - distance) < missed
    return Steps("sneak", sneaking) if nearer else Steps("walk", walking)
