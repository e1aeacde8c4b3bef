"""What a design is by itself: how its blocks are joined, and its scenario, with a step limit by one rule.

The blocks are joined by their edges, by edges and corners, or not at all. All else comes from another scenario.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace
from math import ceil

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build, out_of_reach
from mc_nested.arena.scenario import Scenario

EDGE, CORNER, SCATTERED = "edge", "corner", "scattered"

KINDS = (EDGE, CORNER, SCATTERED)
"""Every kind; a design is of exactly one."""

BESIDE: Sequence[Cell] = ((0, 1), (0, -1), (-1, 0), (1, 0))
"""Steps to the cells that share an edge."""

DIAGONAL: Sequence[Cell] = ((-1, -1), (-1, 1), (1, -1), (1, 1))
"""Steps to the cells that share only a corner."""


def kind_of_design(design: Collection[Cell]) -> str:
    """Return the kind of a design of at least one block.

    ``edge``: every block is reached from every other over shared edges. ``corner``: over edges and corners, but not
    over edges alone, like the zigzag and the diamond. ``scattered``: not even over corners.
    """
    if _is_connected(design, BESIDE):
        return EDGE
    return CORNER if _is_connected(design, (*BESIDE, *DIAGONAL)) else SCATTERED


def neighbours(cell: Cell, steps: Sequence[Cell]) -> list[Cell]:
    """Return the cells that those steps lead to, inside the arena or not."""
    return [(cell[0] + right, cell[1] + forward) for right, forward in steps]


def _is_connected(design: Collection[Cell], steps: Sequence[Cell]) -> bool:
    first = next(iter(design))
    reached, ends = {first}, [first]
    while ends:
        found = [cell for cell in neighbours(ends.pop(), steps) if cell in design and cell not in reached]
        reached.update(found)
        ends += found
    return len(reached) == len(set(design))


FEWEST_STEPS = 60
"""The shipped designs' limit, and the lowest."""

BUILDERS_STEPS = 1.5
"""The limit of a design that takes longer, in steps of the scripted builder."""


def scenario_of_design(name: str, design: frozenset[Cell], like: Scenario) -> Scenario | None:
    """Return a scenario with that design, its start cell and materials those of ``like``.

    The step limit is 60, or one and a half times what the scripted builder takes, whichever is more. None if the
    builder can't build the design within it.
    """
    scenario = replace(like, name=name, design=design)
    limit = max(FEWEST_STEPS, ceil(BUILDERS_STEPS * len(build(scenario))))
    scenario = replace(scenario, step_limit=limit)
    return scenario if is_buildable(scenario) else None


def is_buildable(scenario: Scenario) -> bool:
    """Return whether the scripted builder builds exactly the design within the step limit."""
    return not out_of_reach(scenario) and len(build(scenario)) <= scenario.step_limit
