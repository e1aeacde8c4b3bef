"""Which key really goes which way, found from where a step with each of the four ended."""

from collections.abc import Mapping
from typing import Literal, get_args

from mc_nested.errors import UserError
from mc_nested.live.profile.tables import KeysTable

Direction = Literal["forward", "back", "left", "right"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)

MIN_STEP = 0.1
"""Blocks below which a step has gone nowhere: sneaking for five ticks covers three times as much."""

MAX_SIDE_SHARE = 0.25
"""How far sideways a step may lead, as a share of its length."""


def direction_of(offset: tuple[float, float]) -> Direction | None:
    """The direction of an offset in blocks (right, forward); None if it is too short, or between two directions."""
    right, forward = offset
    along, aside = max(abs(right), abs(forward)), min(abs(right), abs(forward))
    if along < MIN_STEP or aside > MAX_SIDE_SHARE * along:
        return None
    if abs(forward) > abs(right):
        return "forward" if forward > 0 else "back"
    return "right" if right > 0 else "left"


def corrected_keys(keys: KeysTable, observed: Mapping[Direction, Direction | None]) -> KeysTable:
    """The keys, each at the direction that it really goes; ``observed`` says where the key of each direction led.

    Raises:
        UserError: a key goes nowhere, or two go the same way.
    """
    for direction, found in observed.items():
        if found is None:
            raise UserError(
                f"the key {getattr(keys, direction)} doesn't move the player {direction}: write the game's own keys "
                "into the profile's [keys], and leave a block of free floor on every side"
            )
    found_keys = {str(found): getattr(keys, direction) for direction, found in observed.items()}
    if set(found_keys) != set(DIRECTIONS):
        all_found = ", ".join(f"{getattr(keys, direction)} goes {found}" for direction, found in observed.items())
        raise UserError(
            f"the keys don't go four ways ({all_found}): write the game's own keys into the profile's [keys]"
        )
    return keys.model_copy(update=found_keys)


def describe_keys(before: KeysTable, after: KeysTable) -> str:
    """Which key goes which way, and which ones the profile had differently."""
    found = ", ".join(f"{getattr(after, direction)} goes {direction}" for direction in DIRECTIONS)
    changed = [direction for direction in DIRECTIONS if getattr(before, direction) != getattr(after, direction)]
    return f"{found}; the profile had {' and '.join(changed)} the other way round" if changed else found
