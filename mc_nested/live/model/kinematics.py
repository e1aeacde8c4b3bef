"""The recurrence of walking (FACTS: Walking): how far a held key walks, and which hold ends nearest a target.

In each tick the velocity becomes 0 if it is below the standstill, and grows by the push of a held key. The walker moves
by it, and it is multiplied by the inertia.
"""

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


def ticked(position: float, velocity: float, push: float, inertia: float) -> tuple[float, float]:
    """Return a walker's position and velocity a tick later; ``push`` is what a held key adds, 0 with every key up."""
    step = (velocity if abs(velocity) >= STANDSTILL else 0.0) + push
    return position + step, step * inertia


def held(
    ticks: int, push: float, inertia: float, position: float = 0.0, velocity: float = 0.0
) -> list[tuple[float, float]]:
    """Return the positions and velocities before the first and after each of so many ticks with the key down."""
    states = [(position, velocity)]
    for _ in range(ticks):
        states.append(ticked(*states[-1], push, inertia))
    return states


def coasted(position: float, velocity: float, inertia: float) -> list[tuple[float, float]]:
    """Return the positions and velocities before the first and after each tick with every key up, until standstill."""
    states = [(position, velocity)]
    while abs(velocity) >= STANDSTILL:
        position, velocity = position + velocity, velocity * inertia
        states.append((position, velocity))
    return states


def hold_path(ticks: int, push: float = PUSH, inertia: float = INERTIA) -> tuple[float, ...]:
    """Return the position after each tick of a hold of ``ticks`` ticks from rest, in blocks, until standstill."""
    states = held(ticks, push, inertia)
    return tuple(position for position, _ in states[:-1] + coasted(*states[-1], inertia))


def hold_paths(most: int, push: float, inertia: float) -> list[tuple[float, ...]]:
    """Return the paths of the holds of 0 to ``most`` ticks, each as of ``hold_path``."""
    states = held(most, push, inertia)
    paths = [states[:ticks] + coasted(*state, inertia) for ticks, state in enumerate(states)]
    return [tuple(position for position, _ in path) for path in paths]


def displacement(ticks: int, inertia: float = INERTIA) -> float:
    """Return the blocks covered by holding a key for ``ticks`` ticks from rest, then coasting; the push is stone's."""
    return hold_path(ticks, PUSH, inertia)[-1]


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
