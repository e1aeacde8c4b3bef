"""The recurrence of walking (FACTS: Walking): how far a held key walks, and which hold ends nearest a target.

In each tick the velocity becomes 0 if it is below the standstill, and grows by the push of a held key. The walker moves
by it, and it is multiplied by the inertia.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

TICK_S = 0.05
"""Seconds of a game tick (FACTS: Walking)."""

INERTIA = 0.6 * 0.91
"""The share of a step that is left after a tick, on stone."""

STANDSTILL = 0.003
"""Blocks a tick: a slower walker stands still."""

SNEAKING = 0.3
"""The share of a push that is left when sneaking."""

PUSH = 0.98 * 0.1 * 0.1627714 / INERTIA**3
"""Blocks that a held key adds to each tick's step when walking."""

Gait = Literal["walk", "sneak"]


@dataclass(frozen=True)
class HoldPlan:
    """A plan for holding a key: the gait and the number of ticks."""

    gait: Gait
    ticks: int


def step_of(velocity: float, push: float = 0.0) -> float:
    """Return the blocks that a walker moves in its next tick; ``push`` is what a held key adds, 0 with every key up."""
    return (velocity if abs(velocity) >= STANDSTILL else 0.0) + push


def hold_path(ticks: int, push: float = PUSH, inertia: float = INERTIA) -> tuple[float, ...]:
    """Return the position after each tick of a hold of ``ticks`` ticks from rest, in blocks, until standstill."""
    positions, velocities = _held(ticks, push, inertia)
    return (*positions, *_coasted(positions[-1], velocities[-1], inertia))


def hold_paths(most: int, push: float, inertia: float) -> list[tuple[float, ...]]:
    """Return the paths of the holds of 0 to ``most`` ticks, each as of ``hold_path``."""
    positions, velocities = _held(most, push, inertia)
    return [
        (*positions[: ticks + 1], *_coasted(positions[ticks], velocities[ticks], inertia)) for ticks in range(most + 1)
    ]


def _held(ticks: int, push: float, inertia: float) -> tuple[list[float], list[float]]:
    """Return the positions and velocities before the first and after each of so many ticks with the key down."""
    positions, velocities = [0.0], [0.0]
    for _ in range(ticks):
        step = step_of(velocities[-1], push)
        positions.append(positions[-1] + step)
        velocities.append(step * inertia)
    return positions, velocities


def _coasted(position: float, velocity: float, inertia: float) -> list[float]:
    """Return the positions after each tick with the key up, until standstill."""
    positions = []
    while velocity >= STANDSTILL:
        position, velocity = position + velocity, velocity * inertia
        positions.append(position)
    return positions


def displacement(ticks: int, inertia: float = INERTIA) -> float:
    """Return the blocks covered by holding a key for ``ticks`` ticks from rest, then coasting; the push is stone's."""
    return hold_path(ticks, PUSH, inertia)[-1]


def coasting_distance(velocity: float, inertia: float = INERTIA) -> float:
    """Return the blocks that a walker with this velocity still covers until it stops, with every key up."""
    if abs(velocity) < STANDSTILL:
        return 0.0
    # The steps shrink to the first one below the standstill, which isn't taken.
    steps = math.floor(math.log(STANDSTILL / abs(velocity)) / math.log(inertia)) + 1
    return velocity * (1 - inertia**steps) / (1 - inertia)


def walk_response(longest: int) -> tuple[float, ...]:
    """Return the blocks covered by walking holds of 1, 2 ... ``longest`` ticks."""
    return tuple(displacement(ticks) for ticks in range(1, longest + 1))


def nearest_ticks(distance: float, response: Sequence[float]) -> int:
    """Return the hold, in ticks, that ends nearest ``distance`` blocks away; 0 if standing still is nearest.

    ``response[n - 1]`` is the distance that ``n`` ticks cover; for a longer distance than the last, the last is taken.
    """
    ends = [0.0, *response]
    return min(range(len(ends)), key=lambda ticks: abs(ends[ticks] - distance))


def push_of(response: Sequence[float], inertia: float = INERTIA) -> float:
    """Return the blocks that a held key adds to each tick's step, for a walker that covers what ``response`` says."""
    return PUSH * response[-1] / displacement(len(response), inertia)


def plan_hold(
    distance: float,
    response: Sequence[float],
    tolerance: float,
    sneaking: float = SNEAKING,
    *,
    must_sneak: bool = False,
) -> HoldPlan:
    """Return the walking hold that ends nearest.

    If that ends outside the tolerance, return the nearer of walking and sneaking.

    Sneaking covers ``sneaking`` times as much as walking. The hold is at least one tick long: an agent that has to move
    must not wait for a smaller step than there is. With ``must_sneak`` walking isn't considered.
    """
    walk_ticks = max(1, nearest_ticks(distance, response))
    walk_error = abs(response[walk_ticks - 1] - distance)
    if walk_error <= tolerance and not must_sneak:
        return HoldPlan("walk", walk_ticks)
    sneak_response = [sneaking * covered for covered in response]
    sneak_ticks = max(1, nearest_ticks(distance, sneak_response))
    is_sneaking_nearer = must_sneak or abs(sneak_response[sneak_ticks - 1] - distance) < walk_error
    return HoldPlan("sneak", sneak_ticks) if is_sneaking_nearer else HoldPlan("walk", walk_ticks)
