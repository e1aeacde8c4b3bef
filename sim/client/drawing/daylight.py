"""How bright the world is: the sky, how much light a block's faces get, and the fog in the distance.

The window's scene (sim/window) and the client's own pictures are lit by these alike.
"""

SKY = (0.47, 0.65, 1.0)
"""Red, green and blue, from 0 to 1."""

TOP, BOTTOM, NORTH_AND_SOUTH, EAST_AND_WEST = 1.0, 0.5, 0.8, 0.62
"""The part of its colour that a face shows, by where it looks."""

FOG_FROM = 0.3
"""The part of the farthest distance at which the fog begins; at the end of it there is nothing else."""


def light(axis: int, side: int) -> float:
    """The light on a face across ``axis`` (0 east, 1 up, 2 south), on its high (1) or low side (0)."""
    if axis == 1:
        return TOP if side else BOTTOM
    return EAST_AND_WEST if axis == 0 else NORTH_AND_SOUTH
