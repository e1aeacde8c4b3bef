"""The arena's table: where it lies in the world, which blocks a reset may clear, and the boxes that one is built of.

A box is two corners, the lowest and the highest, both inside.

border       a ring of blocks on the ground around the arena's cells
. . . . . . . . .     the marked region: two blocks of air above the floor
# # # # # # # # #     the floor, under the cells and the border
"""

import math
from collections.abc import Sequence

from pydantic import ConfigDict, Field, model_validator

from mc_nested.arena.action import LARGEST_SIZE, Cell
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.live.model import coordinates
from mc_nested.live.model.coordinates import Facing, GroundVector
from mc_nested.live.model.reading import Block
from mc_nested.toml_file import TomlTable

Box = tuple[Block, Block]

FLOOR = "obsidian"
"""Plain to walk on, with one name in every version, and not a material of a shipped scenario."""

BORDERS = ("lapis_block", "mossy_cobblestone")
"""One name in every version; no white, since text would be unreadable on it; and not to be mistaken for a placed block.
The first that is not a material is used."""

FILL_LIMIT = 32768
"""Blocks that one /fill may change (FACTS: Commands)."""


def near_middle(size: int) -> Cell:
    """Return the cell in the middle of an arena's near edge: where the player stands when it is marked."""
    return size // 2, 0


def size_for(scenario: Scenario) -> int:
    """Return how many cells a side of the arena has to have for a scenario.

    A small scenario is played in a part of it.
    """
    return max(DEFAULT_SIZE, scenario.size)


class ProfileTable(TomlTable):
    """A table of a profile: all its numbers are finite."""

    model_config = ConfigDict(allow_inf_nan=False)


class Arena(ProfileTable):
    """Where the arena lies in the world."""

    origin: Block = Field(
        description="the block of cell (0, 0), as x, y, z: y is the level of the feet",
    )
    facing: Facing = Field(
        description="the way the agent looks: where the cells' y grows",
    )
    size: int = Field(
        default=DEFAULT_SIZE,
        ge=DEFAULT_SIZE,
        le=LARGEST_SIZE,
        description="cells along each side that calibrate arena was told: no larger scenario is played here",
    )
    marked: tuple[Block, Block] = Field(
        description="two opposite corners of the blocks that a reset may clear; nothing outside is ever touched"
    )
    floor: str | None = Field(
        pattern=r"^[a-z0-9_.:/-]+$",
        default=None,
        description="the floor's block, as this game names it: a reset fills holes in the floor with it; left out, "
        "holes stay",
    )
    copied_to: Block | None = Field(
        default=None,
        description="the lowest corner of the copy of what stood there before: what calibrate arena --undo puts back",
    )

    @model_validator(mode="after")
    def _is_marked(self) -> "Arena":
        low, high = self.region
        corners = (self.block_of((0, 0)), self.block_of((self.size - 1, self.size - 1)))
        if any(not low[axis] <= corner[axis] <= high[axis] for corner in corners for axis in range(3)):
            raise ValueError("the marked blocks don't hold the whole arena: run mc-nested calibrate arena")
        if low[1] < self.origin[1]:
            raise ValueError("the marked blocks reach below the feet, into the floor: run mc-nested calibrate arena")
        if math.prod(high[axis] - low[axis] + 1 for axis in range(3)) > FILL_LIMIT:
            raise ValueError(
                f"more than {FILL_LIMIT} blocks are marked, too many for the game to clear at once: mark fewer"
            )
        return self

    @classmethod
    def around(cls, origin: Block, facing: Facing, height: int = 2, size: int = DEFAULT_SIZE) -> "Arena":
        """Return the arena that starts at ``origin``, marked ``height`` blocks high: 2 is as tall as the player."""
        x, y, z = coordinates.block_of(origin, facing, (size - 1, size - 1))
        return cls(origin=origin, facing=facing, size=size, marked=(origin, (x, y + height - 1, z)))

    @property
    def region(self) -> Box:
        """The lowest and the highest corner of the marked blocks, both included."""
        return coordinates.corners_of(*self.marked)

    @property
    def middle(self) -> Cell:
        """The cell with the most room around it."""
        return self.size // 2, self.size // 2

    @property
    def near_middle(self) -> Cell:
        """The cell in the middle of the near edge: the whole arena lies in plain view in front of it."""
        return near_middle(self.size)

    @property
    def yaw(self) -> float:
        """The agent's yaw in degrees."""
        return coordinates.yaw_of(self.facing)

    def block_of(self, cell: Cell) -> Block:
        """Return the block that fills a cell."""
        return coordinates.block_of(self.origin, self.facing, cell)

    def centre_of(self, cell: Cell) -> tuple[float, float, float]:
        """Return where the agent's feet are in the middle of a cell."""
        return coordinates.centre_of(self.origin, self.facing, cell)

    def position_of(self, xyz: tuple[float, float, float]) -> GroundVector:
        """Return the position ``xyz`` in cells, as (right, forward); whole numbers are the middles of cells."""
        return coordinates.position_of(self.origin, self.facing, xyz)


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
    return [coordinates.corners_of(one, other) for one, other in zip(corners, [*corners[1:], corners[0]], strict=True)]
