"""The names of keys, as in profiles and in the game's own options. A name means a place (key_places.py)."""

from mc_nested.errors import ProfileError
from mc_nested.live.model.key_places import PLACES, KeyPlace

_ALIASES = {"escape": "esc", "caps_lock": "caps.lock", "page_up": "page.up", "page_down": "page.down"}


def canonical(name: str) -> str:
    """The one name of what ``name`` means: "esc" for "escape", "w" for "W". Any other name stays as it is."""
    return name.lower() if len(name) == 1 else _ALIASES.get(name, name)


def is_key(name: str) -> bool:
    """Whether a key has this name."""
    return canonical(name) in PLACES


def check_key(name: str) -> None:
    """ProfileError where no key has this name."""
    if not is_key(name):
        words = ", ".join(sorted(word for word in PLACES if len(word) > 1 and "." in word))
        raise ProfileError(
            f"no key is named {name!r}: write what a US keyboard types there without Shift, or one of {words}, "
            "space, tab, enter, esc, f1 to f20 and so on"
        )


def place_of(name: str) -> KeyPlace:
    """The key of that name; ProfileError where there is none."""
    check_key(name)
    return PLACES[canonical(name)]
