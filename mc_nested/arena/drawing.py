"""The arena from above, the far edge on top: what each cell shows, and all of them as text."""

from collections.abc import Collection

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario

AGENT, BUILT, WRONG, MISSING, FREE = "^", "#", "x", "o", "."

PARTS = "123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"
"""With parts, a cell to build shows the number of its part; MISSING where there are more of them."""


def kind_of(scenario: Scenario, agent: Cell | None, placed: Collection[Cell], cell: Cell) -> str:
    """What to draw in a cell: the agent, a block on the design, a block off it, a design cell to build, or nothing.

    With parts, a cell to build is drawn as its part's number.
    """
    if cell == agent:
        return AGENT
    if cell in placed:
        return BUILT if cell in scenario.design else WRONG
    return missing_in(scenario, cell) if cell in scenario.design else FREE


def missing_in(scenario: Scenario, cell: Cell) -> str:
    """The sign of a cell of the design that is still to build."""
    number = part_of(scenario, cell)
    return PARTS[number] if scenario.parts and number < len(PARTS) else MISSING


def part_of(scenario: Scenario, cell: Cell) -> int:
    """Index of the part that a cell belongs to; 0 if it is off the design."""
    return next((number for number, part in enumerate(scenario.in_order) if cell in part.cells), 0)


def draw_text(scenario: Scenario, agent: Cell | None, placed: Collection[Cell]) -> str:
    """The arena as a line of text a row, two characters a cell so that it looks square in a terminal."""
    across = range(scenario.size)
    rows = (" ".join(kind_of(scenario, agent, placed, (x, y)) for x in across) for y in reversed(across))
    return "\n".join(rows)
