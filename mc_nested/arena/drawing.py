"""The arena from above, the far edge on top: what each cell shows, and all of them as text."""

from collections.abc import Collection

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario

AGENT, BUILT, WRONG, MISSING, FREE = "^", "#", "x", "o", "."


def kind_of(scenario: Scenario, agent: Cell | None, placed: Collection[Cell], cell: Cell) -> str:
    """What to draw in a cell: the agent, a block on the design, a block off it, a design cell to build, or nothing."""
    if cell == agent:
        return AGENT
    if cell in placed:
        return BUILT if cell in scenario.design else WRONG
    return MISSING if cell in scenario.design else FREE


def draw_text(scenario: Scenario, agent: Cell | None, placed: Collection[Cell]) -> str:
    """The arena as a line of text a row, two characters a cell so that it looks square in a terminal."""
    across = range(scenario.size)
    rows = (" ".join(kind_of(scenario, agent, placed, (x, y)) for x in across) for y in reversed(across))
    return "\n".join(rows)
