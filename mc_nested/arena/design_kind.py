"""How a design's blocks hang together: by their edges, by corners at least, or not at all."""

from collections.abc import Collection, Sequence

from mc_nested.arena.action import Cell

EDGE, CORNER, SCATTERED = "edge", "corner", "scattered"

KINDS = (EDGE, CORNER, SCATTERED)
"""Every kind; a design is of exactly one."""

BESIDE: Sequence[Cell] = ((0, 1), (0, -1), (-1, 0), (1, 0))
"""Steps to the cells that share an edge."""

DIAGONAL: Sequence[Cell] = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""Steps to the cells that share only a corner."""


def kind_of_design(design: Collection[Cell]) -> str:
    """The kind of a design of at least one block.

    ``edge``: every block is reached from every other over shared edges. ``corner``: over edges and corners, but not
    over edges alone, like the zigzag and the diamond. ``scattered``: not even so.
    """
    if _is_connected(design, BESIDE):
        return EDGE
    return CORNER if _is_connected(design, (*BESIDE, *DIAGONAL)) else SCATTERED


def neighbours(cell: Cell, steps: Sequence[Cell]) -> list[Cell]:
    """The cells that those steps lead to, inside the arena or not."""
    return [(cell[0] + right, cell[1] + forward) for right, forward in steps]


def _is_connected(design: Collection[Cell], steps: Sequence[Cell]) -> bool:
    first = next(iter(design))
    reached, ends = {first}, [first]
    while ends:
        found = [cell for cell in neighbours(ends.pop(), steps) if cell in design and cell not in reached]
        reached.update(found)
        ends += found
    return len(reached) == len(set(design))
