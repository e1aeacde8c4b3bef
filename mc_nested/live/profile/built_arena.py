"""The boxes that a built arena is made of. Pure. A box is two corners, the lowest and the highest, both inside.

border       a ring of blocks on the ground around the arena's cells
. . . . . . . . .     the marked region: two blocks of air above the floor
# # # # # # # # #     the floor, under the cells and the border
"""

from collections.abc import Sequence

from mc_nested.live.model.coordinates import corners_of
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import Arena

Box = tuple[Block, Block]

FLOOR = "obsidian"
"""Plain to walk on, with one name in every version, and not a material of a shipped scenario."""

BORDERS = ("lapis_block", "mossy_cobblestone")
"""One name in every version; no white, since text would be unreadable on it; and not to be mistaken for a placed block.
The first that is not a material is used."""


def box_of(arena: Arena) -> Box:
    """Return everything that a build changes: the region, the border around it, and the floor under both."""
    (x, y, z), (other_x, other_y, other_z) = arena.region
    return (x - 1, y - 1, z - 1), (other_x + 1, other_y, other_z + 1)


def floor_of(arena: Arena) -> Box:
    """Return the floor under the cells and the border."""
    low, high = box_of(arena)
    return low, (high[0], low[1], high[2])


def border_block(materials: Sequence[str]) -> str:
    """Return the border's block, given the scenario's materials."""
    return next(block for block in BORDERS if block not in materials)


def border_of(arena: Arena) -> list[Box]:
    """Return the four sides of the ring."""
    size = arena.size
    corners = [arena.block_of(cell) for cell in ((-1, -1), (size, -1), (size, size), (-1, size))]
    return [corners_of(one, other) for one, other in zip(corners, [*corners[1:], corners[0]], strict=True)]
