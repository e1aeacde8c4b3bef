"""Which key really goes which way: told from where a step with each of the four ended."""

from collections.abc import Mapping
from typing import Literal, get_args

from mc_nested.errors import UserError
from mc_nested.live.profile_tables import Keys

Way = Literal["forward", "back", "left", "right"]
WAYS: tuple[Way, ...] = get_args(Way)

LEAST = 0.1
"""Blocks below which a step has gone nowhere: sneaking for five ticks covers three times as much."""

ASKEW = 0.25
"""How far aside a step may lead, as a part of its way."""


def way_of(place: tuple[float, float]) -> Way | None:
    """The way to a place in blocks (right, forward); None where it leads nowhere, or between two ways."""
    right, forward = place
    along, aside = max(abs(right), abs(forward)), min(abs(right), abs(forward))
    if along < LEAST or aside > ASKEW * along:
        return None
    if abs(forward) > abs(right):
        return "forward" if forward > 0 else "back"
    return "right" if right > 0 else "left"


def keys_found(keys: Keys, went: Mapping[Way, Way | None]) -> Keys:
    """The keys, each at the way that it really goes; ``went`` says where the key of each way led.

    Raises:
        UserError: a key goes nowhere, or two go the same way.
    """
    for way, found in went.items():
        if found is None:
            raise UserError(
                f"the key {getattr(keys, way)} moves nobody {way}: write the game's own keys into the profile's "
                "[keys], and leave a block of free floor on every side"
            )
    found_keys = {str(found): getattr(keys, way) for way, found in went.items()}
    if set(found_keys) != set(WAYS):
        twice = ", ".join(f"{getattr(keys, way)} goes {found}" for way, found in went.items())
        raise UserError(f"the keys don't go four ways ({twice}): write the game's own keys into the profile's [keys]")
    return keys.model_copy(update=found_keys)


def keys_in_words(before: Keys, after: Keys) -> str:
    """Which key goes which way, and what was otherwise in the profile."""
    found = ", ".join(f"{getattr(after, way)} goes {way}" for way in WAYS)
    changed = [way for way in WAYS if getattr(before, way) != getattr(after, way)]
    return f"{found}; the profile had {' and '.join(changed)} the other way round" if changed else found
