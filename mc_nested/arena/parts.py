"""Parts: a design that is built one part after the other, and what each material is worth in each of them.

The main agent chooses a material for every part: the paper's "could take more than one action" (section 4.1). Without
parts, a design is one part, and everything here is the paper's r_M.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
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


def part_after(laid: int, parts: Sequence[Part]) -> int:
    """Index of the part that is built once so many blocks are laid; the last one when all are."""
    ends = accumulate(len(part.cells) for part in parts[:-1])
    return sum(laid >= end for end in ends)


def main_return(on_part: Int64s, laid: NDArray[Any], worth: Float64s, sizes: Int64s) -> Float64s:
    """r_M of R episodes, (R,): the blocks on the cells of their part, plus the shares of p.

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
    """ScenarioError, one line, if the parts overlap, don't cover the design, or one isn't worth beginning."""
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
