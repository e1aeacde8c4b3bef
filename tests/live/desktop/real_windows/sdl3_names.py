"""SDL 3's names of the keys at their places, but for the two beside Alt, which each system names in its way."""

from mc_nested.live.model.keys import PLACES

_NAMES = {
    "esc": "Escape",
    "enter": "Return",
    "caps.lock": "CapsLock",
    "page.up": "PageUp",
    "page.down": "PageDown",
    **{f"{side}.win": f"{side.title()} GUI" for side in ("left", "right")},
    **{f"{side}.control": f"{side.title()} Ctrl" for side in ("left", "right")},
}
"""SDL's names of scancodes, where they aren't the project's own in other words."""


def expected_keys() -> dict[str, list[list[object]]]:
    """Return the scancode's name, down and up, for each place."""
    words = {place: place.replace(".", " ").title() if len(place) > 1 else place.upper() for place in PLACES}
    names = words | _NAMES
    return {place: [[name, 1], [name, 0]] for place, name in names.items()}
