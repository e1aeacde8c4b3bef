"""A bitmap font drawn for this project: the virtual client's letters, in the layout of the game's ``ascii.png``.

The shapes are drawn in ``glyphs.txt``: lines of up to eight characters, each with its eight rows of dots below it.
"""

from importlib import resources

import numpy as np
from numpy.typing import NDArray

_FIELD = 7
_ROWS = 8


def drawn_atlas() -> NDArray[np.uint8]:
    """The font picture (128, 128, 4): 16 x 16 cells of 8 x 8 dots, white, alpha 0 or 255 (FACTS: The bitmap font)."""
    atlas = np.full((128, 128, 4), (255, 255, 255, 0), np.uint8)
    for char, cell in _drawings().items():
        top, left = (index * _ROWS for index in divmod(ord(char), 16))
        atlas[top : top + cell.shape[0], left : left + cell.shape[1], 3] = np.where(cell, 255, 0)
    return atlas


def _drawings() -> dict[str, NDArray[np.bool_]]:
    text = resources.files("sim.client.drawing").joinpath("glyphs.txt").read_text(encoding="ascii")
    drawings = {}
    for block in text.strip().split("\n\n"):
        names, *rows = block.splitlines()
        for column in range(0, len(names), _FIELD):
            cell = [[dot == "#" for dot in row[column : column + _FIELD - 1]] for row in rows]
            drawings[names[column]] = np.array(cell)
    return drawings
