"""The arena from above, the far edge on top, as text and as a picture."""

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario

AGENT, BUILT, WRONG, MISSING, FREE = "^", "#", "x", "o", "."

CELL_PX = 16
"""Side of a cell in the picture."""

COLOURS: dict[str, tuple[int, int, int]] = {
    AGENT: (214, 69, 65),
    BUILT: (110, 110, 118),
    WRONG: (231, 161, 60),
    MISSING: (178, 205, 232),
    FREE: (236, 240, 233),
}
"""RGB of each kind of cell."""


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


def draw_picture(scenario: Scenario, agent: Cell | None, placed: Collection[Cell]) -> NDArray[np.uint8]:
    """The arena as (16 size, 16 size, 3) RGB: a square per cell, with thin lines between."""
    size = scenario.size
    picture = np.full((size * CELL_PX, size * CELL_PX, 3), 200, dtype=np.uint8)
    for x in range(size):
        for y in range(size):
            top, left = (size - 1 - y) * CELL_PX, x * CELL_PX
            colour = COLOURS[kind_of(scenario, agent, placed, (x, y))]
            picture[top + 1 : top + CELL_PX, left + 1 : left + CELL_PX] = colour
    return picture
