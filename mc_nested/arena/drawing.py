"""The arena from above, the far edge on top, as text and as a picture: what an Env renders, and what a film shows.

A picture takes NumPy alone. Every cell is a tile of its kind, drawn once for each size; the agent lies over its cell,
an arrow in the direction it looks. Edges are smooth: each pixel is the mean of SAMPLES x SAMPLES points.
"""

from collections.abc import Collection
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Bools, Float64s

AGENT, BUILT, WRONG, MISSING, FREE = "^", "#", "x", "o", "."

PARTS = "123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"
"""With parts, a cell to build shows the number of its part; MISSING where there are more of them."""


def kind_of(scenario: Scenario, agent: Cell | None, placed: Collection[Cell], cell: Cell) -> str:
    """Return what to draw in a cell: the agent, a block on or off the design, a design cell to build, or nothing.

    With parts, a cell to build is drawn as its part's number.
    """
    if cell == agent:
        return AGENT
    if cell in placed:
        return BUILT if cell in scenario.design else WRONG
    if cell not in scenario.design:
        return FREE
    number = part_of(scenario, cell)
    return PARTS[number] if scenario.parts and number < len(PARTS) else MISSING


def part_of(scenario: Scenario, cell: Cell) -> int:
    """Return the index of the part that a cell belongs to; 0 if it is off the design."""
    return next((number for number, part in enumerate(scenario.in_order) if cell in part.cells), 0)


def draw_text(scenario: Scenario, agent: Cell | None, placed: Collection[Cell]) -> str:
    """Return the arena as a line of text a row, two characters a cell so that it looks square in a terminal."""
    across = range(scenario.size)
    rows = (" ".join(kind_of(scenario, agent, placed, (x, y)) for x in across) for y in reversed(across))
    return "\n".join(rows)


Picture = NDArray[np.uint8]
"""(height, width, 3), red green blue."""

Colour = tuple[int, int, int]

CELL_PX = 16
"""Side of a cell in the picture that an Env renders."""

SAMPLES = 4
"""Points along each side of a pixel."""

GROUND: Colour = (236, 240, 233)
GRID: Colour = (213, 219, 208)
TO_BUILD: tuple[Colour, ...] = ((205, 222, 240), (239, 212, 232), (208, 232, 208), (243, 226, 196))
"""A cell to build, in the first part, the second, and so on; from the fifth on they come again."""

DESIGN: tuple[Colour, ...] = ((52, 108, 170), (158, 60, 136), (50, 126, 62), (168, 104, 18))
"""The outline of every cell of the design, built or not, in the same order."""

BLOCKS: dict[str, tuple[Colour, Colour, Colour]] = {
    BUILT: ((124, 126, 132), (166, 168, 174), (86, 88, 94)),
    WRONG: ((226, 150, 52), (246, 190, 110), (170, 104, 24)),
}
"""A block's top, its lit edges and its dark ones: on the design, and off it."""

AGENT_BODY: Colour = (208, 52, 48)
AGENT_ARROW: Colour = (255, 255, 255)

COLOURS: tuple[Colour, ...] = (
    *(GROUND, GRID, AGENT_BODY, AGENT_ARROW),
    *(colour for part in zip(TO_BUILD, DESIGN, strict=True) for colour in part),
    *(colour for block in BLOCKS.values() for colour in block),
)
"""All of these; what lies between two of them is an edge."""


def draw_picture(scenario: Scenario, agent: Cell | None, placed: Collection[Cell], cell_px: int = CELL_PX) -> Picture:
    """Draw the arena, (size * cell_px, size * cell_px, 3): the outlined design, the blocks, the agent looking up."""
    size = scenario.size
    tiles = np.array(
        [
            [
                _tile(kind_of(scenario, None, placed, (x, y)), part_of(scenario, (x, y)) % len(DESIGN), cell_px)
                for x in range(size)
            ]
            for y in reversed(range(size))
        ]
    )
    picture: Picture = tiles.swapaxes(1, 2).reshape(size * cell_px, size * cell_px, 3)
    if agent is not None:
        draw_agent(picture, size, agent, cell_px)
    return picture


def draw_objective(picture: Picture, size: int, objective: Cell, cell_px: int) -> None:
    """Frame the cell that the agent is after, in the agent's colour, in an arena's picture."""
    here = _cell_of(picture, size, objective, cell_px)
    here[:] = _rounded(_framed(here.astype(np.float64), AGENT_BODY, max(2.0, cell_px / 8)))


def draw_agent(picture: Picture, size: int, agent: Cell, cell_px: int, body: Colour = AGENT_BODY) -> None:
    """Lay an agent of that colour over its cell of an arena's picture."""
    here = _cell_of(picture, size, agent, cell_px)
    here[:] = _with_agent(here, body)


def _cell_of(picture: Picture, size: int, cell: Cell, cell_px: int) -> Picture:
    """Return a cell's pixels in an arena's picture, to be drawn on."""
    top, left = (size - 1 - cell[1]) * cell_px, cell[0] * cell_px
    return picture[top : top + cell_px, left : left + cell_px]


@lru_cache(maxsize=256)
def _tile(kind: str, part: int, px: int) -> Picture:
    """Return one cell of that kind and part, (px, px, 3); the line of the grid runs along its top and its left."""
    across, down = _points(px)
    line = 1 / px
    tile = np.full((px, px, 3), GRID, dtype=np.float64)
    tile = _painted(tile, GROUND, (across > line) & (down > line))
    if kind == FREE:
        return _rounded(tile)
    edge_px = max(1.5, px / 10)
    if kind not in BLOCKS:
        return _rounded(_framed(_painted(tile, TO_BUILD[part], _square(px, 1.0)), DESIGN[part], edge_px))
    top, lit, dark = BLOCKS[kind]
    tile = _painted(tile, dark, _square(px, 1.0))
    tile = _painted(tile, lit, _square(px, 1.0) & (across + down < 1 + line))
    tile = _painted(tile, top, _square(px, 1.0 + 1.5 * edge_px))
    return _rounded(_framed(tile, DESIGN[part], edge_px) if kind == BUILT else tile)


def _framed(tile: Float64s, colour: Colour, edge_px: float) -> Float64s:
    px = len(tile)
    return _painted(tile, colour, _square(px, 1.0) & ~_square(px, 1.0 + edge_px))


def _with_agent(tile: Picture, colour: Colour) -> Picture:
    px = len(tile)
    across, down = _points(px)
    middle = 0.5 + 0.5 / px  # of the cell without the grid's line
    right, below = across - middle, down - middle
    body = np.hypot(right, below) < 0.42
    arrow = (below > -0.30) & (below < 0.22) & (2 * np.abs(right) < 1.0 * (below + 0.30))
    notch = (below > 0.04) & (2 * np.abs(right) < 1.1 * (below - 0.04) * 2)
    return _rounded(_painted(_painted(tile.astype(np.float64), colour, body), AGENT_ARROW, arrow & ~notch))


def _points(px: int) -> tuple[Float64s, Float64s]:
    """Return each sample's distances from the tile's left and top, 0 to 1, (px * SAMPLES, px * SAMPLES) each."""
    at = (np.arange(px * SAMPLES) + 0.5) / (px * SAMPLES)
    down, across = np.meshgrid(at, at, indexing="ij")
    return across, down


def _square(px: int, inset_px: float) -> Bools:
    """Return the samples so many pixels within the cell, whose first row and column are the grid's line."""
    across, down = _points(px)
    low, high = inset_px / px, 1 - (inset_px - 1) / px
    inside: Bools = (across > low) & (across < high) & (down > low) & (down < high)
    return inside


def _painted(tile: Float64s, colour: Colour, where: Bools) -> Float64s:
    """Return the tile with a colour laid over the samples."""
    px = len(tile)
    covered = where.reshape(px, SAMPLES, px, SAMPLES).mean(axis=(1, 3))[..., np.newaxis]
    painted: Float64s = tile * (1 - covered) + np.array(colour) * covered
    return painted


def _rounded(tile: Float64s) -> Picture:
    return np.round(tile).astype(np.uint8)
