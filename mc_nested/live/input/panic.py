"""The panic switch: a person stops everything at once, whichever window is in front."""

from collections.abc import Callable, Collection

Stop = Callable[[str], None]
"""Releases everything, and lets nothing be pressed again; takes the reason. Callable from any thread."""

KEY_REASON = "the panic key was pressed"
CORNER_REASON = "the mouse was moved into a corner of the screen"


def corners_of(width: int, height: int) -> Collection[tuple[int, int]]:
    """The corners of a screen of that size, in its own points."""
    return frozenset({(0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)})
