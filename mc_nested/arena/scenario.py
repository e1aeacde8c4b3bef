"""Scenario: the arena's size, the design and its parts, the start cell, the step limit, and each material's value.

Parts are built one after the other, and each says what a material is worth in it. The main agent chooses a material for
every part: the paper's "could take more than one action" (section 4.1). Without parts, a design is one part, and
everything here is the paper's r_M.

Where the materials are ``regions``, a main action is an objective: a region of the arena to build in next.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from math import isqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import LARGEST_SIZE, SMALLEST_SIZE, Cell
from mc_nested.arrays import Float64s, Int64s
from mc_nested.errors import ScenarioError


@dataclass(frozen=True)
class Part:
    """Cells that are built together, and what each of the scenario's materials is worth there: its p, in their order.

    p is shared out over the part's blocks: each block brings its share of the p of the material that it is of.
    """

    cells: frozenset[Cell]
    worth: tuple[float, ...]

    @property
    def best_material(self) -> int:
        """Index of the material that is worth most; the first if several are worth the same."""
        return max(range(len(self.worth)), key=lambda index: self.worth[index])


def main_return(on_part: Int64s, laid: NDArray[Any], worth: Float64s, sizes: Int64s) -> Float64s:
    """Return r_M of R episodes, (R,): the blocks on the cells of their part, plus the shares of p.

    With one part and one choice: the blocks on the design, plus p (paper, section 5.1.3).

    Args:
        on_part: blocks that landed on a cell of the part which was built then, (R,).
        laid: blocks that count for each part and material, (R, parts, materials).
        worth: p, (R, parts, materials).
        sizes: cells of each part, (R, parts).
    """
    total = on_part.astype(np.float64)
    # Added up one by one: so the sum of a run doesn't depend on the runs beside it.
    for part in range(worth.shape[1]):
        for material in range(worth.shape[2]):
            total += worth[:, part, material] * (laid[:, part, material] / sizes[:, part])
    return total


def check_parts(parts: Sequence[Part], design: frozenset[Cell]) -> None:
    """Raise ScenarioError, one line, if the parts overlap, don't cover the design, or one isn't worth beginning."""
    taken: set[Cell] = set()
    for number, part in enumerate(parts, 1):
        if not part.cells:
            raise ScenarioError(f"parts: part {number} has no block: draw at least one")
        twice = sorted(taken & part.cells)
        if twice:
            raise ScenarioError(f"parts: cell {twice[0]} is in part {number} and in an earlier one: draw it in one")
        beyond = sorted(part.cells - design)
        if beyond:
            raise ScenarioError(f"parts: cell {beyond[0]} of part {number} is not in the design: draw it there, too")
        most = len(part.cells) + part.worth[part.best_material]
        if number > 1 and most < 0:  # who leaves the part before unfinished would score more than who builds it all
            raise ScenarioError(f"parts: part {number}, built whole, brings at most {most:g}: raise a worth")
        taken |= part.cells
    left = sorted(design - taken)
    if left:
        raise ScenarioError(f"parts: cell {left[0]} of the design is in no part: draw it in one")


def regions_of(size: int, count: int) -> Int64s:
    """Return the region of each cell where an arena is divided into so many, (size, size): the first is near left.

    They lie in as many columns and rows as goes, as near to a square as goes, and as evenly as goes: 2 are a left and a
    right half. ScenarioError if they are more than there are columns or rows for.
    """
    rows = max(number for number in range(1, isqrt(count) + 1) if count % number == 0)
    columns = count // rows
    if columns > size:
        raise ScenarioError(
            f"regions: {size} columns of cells can't be {columns} of regions: take fewer, or another number"
        )
    at = np.arange(size)
    found: Int64s = (at * columns // size)[:, None] * rows + at * rows // size
    return found


DEFAULT_SIZE = 15
"""Cells along each side of the arena, unless a scenario says otherwise (paper, section 5: a 15 by 15 grid)."""


@dataclass(frozen=True)
class Material:
    """A material of the main agent's choice: its name, the p of choosing it (paper, section 5.1.3) and its block id.

    The id is the one of Minecraft 1.13 and later, without its namespace; a profile translates it for other games.
    """

    name: str
    p: float
    block: str


@dataclass(frozen=True)
class Scenario:
    """A task: build the design's cells, one block each, from the start cell within the step limit.

    The arena is ``size`` by ``size`` cells. With ``parts``, the design is built one part after the other, and the main
    agent chooses a material as each begins, and within it every ``choose_every`` steps, if that is given. With
    ``regions``, each material stands for a region of the arena (``regions_of``): a block pays the nested agent in the
    chosen one alone, and the main agent wherever it is on its part; and each block that lands lets it choose again.

    Raises:
        ScenarioError: the arena can't be that large, a cell lies outside, or parts or regions don't fit.
    """

    name: str
    design: frozenset[Cell]
    start: Cell
    step_limit: int
    materials: tuple[Material, ...]
    size: int = DEFAULT_SIZE
    parts: tuple[Part, ...] = ()
    choose_every: int | None = None
    regions: bool = False

    def __post_init__(self) -> None:
        if not SMALLEST_SIZE <= self.size <= LARGEST_SIZE:
            raise ScenarioError(
                f"design: {self.size} x {self.size} cells: an arena has {SMALLEST_SIZE} to {LARGEST_SIZE} a side"
            )
        cells = range(self.size)
        outside = sorted(cell for cell in self.design if cell[0] not in cells or cell[1] not in cells)
        if outside:
            raise ScenarioError(
                f"design: cell {outside[0]} lies outside the arena of {self.size} x {self.size} cells: "
                "make the arena larger, or the design smaller"
            )
        if self.start[0] not in cells or self.start[1] not in cells:
            raise ScenarioError(f"start: {self.start} lies outside: choose 0 to {self.size - 1} for x and y")
        if self.parts:
            check_parts(self.parts, self.design)
        if self.regions:
            regions_of(self.size, len(self.materials))

    @cached_property
    def in_order(self) -> tuple[Part, ...]:
        """The parts in the order in which they are built; the whole design is one if the scenario has none."""
        return self.parts or (Part(self.design, tuple(material.p for material in self.materials)),)

    def part_at(self, blocks_left: int) -> int:
        """Return the index of the part that is built while so many blocks are left; the last one when none is."""
        ends = accumulate(len(part.cells) for part in self.in_order[:-1])
        return sum(self.blocks - blocks_left >= end for end in ends)

    @property
    def blocks(self) -> int:
        """Blocks available: as many as the design needs (paper, section 5.1.1)."""
        return len(self.design)

    @property
    def start_state(self) -> tuple[int, int, int]:
        """(x, y, b) before the first move: what the main agent decides on."""
        return *self.start, self.blocks

    @property
    def best_material(self) -> int:
        """Index of the material that is worth most in the first part; the first if several are worth the same."""
        return self.in_order[0].best_material

    @property
    def best_materials(self) -> tuple[int, ...]:
        """Index of the material that is worth most in each part."""
        return tuple(part.best_material for part in self.in_order)

    @property
    def optimum(self) -> float:
        """The highest score: every block on its part, of the best material there."""
        return sum((max(part.worth) for part in self.in_order), start=float(self.blocks))

    def score(self, placed: Collection[Cell], material: int) -> float:
        """Return r_M of what stands, all of that material: the blocks on the design, plus p; without parts only."""
        return len(self.design.intersection(placed)) + self.materials[material].p

    def material_index(self, name: str) -> int:
        """Return the index of the material of that name; ScenarioError if there is none."""
        names = [material.name for material in self.materials]
        if name not in names:
            raise ScenarioError(f"scenario {self.name} has no material {name!r}: choose one of {', '.join(names)}")
        return names.index(name)
