"""Which key makes a symbol: to 1.12 the game goes by what a key makes, and not by its place.

LWJGL 2 has a key for each character that a US keyboard makes without Shift, and a few more. On X11 it takes what the
layout's first group makes, with Shift where that is down; on Windows the virtual key (FACTS: Input and windows).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from mc_nested.live.model.key_names import canonical
from mc_nested.live.model.key_places import PLACES

Layout = Mapping[str, tuple[str, str]]
"""The key that LWJGL 2 takes each place for, without and with Shift; "" for none. A name is the key's character."""

CHARACTERS = frozenset(place for place in PLACES if len(place) == 1)
"""The keys that are elsewhere under another layout: those of one character. The others are where they are in every."""

SHIFT = "right.shift"
"""The Shift that a digit is pressed with: the left one also makes the player sneak."""


@dataclass(frozen=True)
class KeyStroke:
    """A key, by its place, and whether Shift must be down for it to be the one that is meant."""

    place: str
    takes_shift: bool = False


def taken_for(place: str, layout: Layout, *, has_shift: bool) -> str:
    """The key that LWJGL 2 takes the one at a place for; "" for none."""
    if place not in CHARACTERS:
        return place
    plain, shifted = layout.get(place, ("", ""))
    return (shifted or plain) if has_shift else plain


def stroke_for(key: str, layout: Layout) -> KeyStroke | None:
    """What to press so that LWJGL 2 takes it for ``key``; None where no key of the layout does.

    Only a digit is worth Shift: it acts once, and everything else is held while other keys come and go.
    """
    name = canonical(key)
    if name not in CHARACTERS:
        return KeyStroke(name)
    places = [name, *(place for place in layout if place != name)]
    for has_shift in (False, True) if name.isdigit() else (False,):
        for place in places:
            if taken_for(place, layout, has_shift=has_shift) == name:
                return KeyStroke(place, has_shift)
    return None


def missing_keys(keys: Iterable[str], layout: Layout) -> list[str]:
    """Those of the keys that the layout has no key for."""
    return [key for key in keys if stroke_for(key, layout) is None]
