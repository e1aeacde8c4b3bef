"""The part of a window that has something over the world, as triangles: each pixel is in one of them at most."""

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from sim.client.drawing.layers import Rect, intersection

TILE = 16
"""The side of a tile, in pixels: a tile with anything in it is covered whole."""


def triangles(rects: Sequence[Rect], size: tuple[int, int]) -> NDArray[np.float32]:
    """Return the corners (n, 2) of triangles that cover the rectangles' tiles, in a window of ``size`` pixels.

    Rectangles are in pixels from the upper left corner; corners are OpenGL's, from -1 to 1, y upwards.
    """
    width, height = size
    is_covered = np.zeros((-(-height // TILE), -(-width // TILE)), bool)
    for rect in rects:
        if (inside := intersection(rect, (0, 0, width, height))) is not None:
            left, top, right, bottom = inside
            is_covered[top // TILE : -(-bottom // TILE), left // TILE : -(-right // TILE)] = True
    corners = [corner for row, tiles in enumerate(is_covered) for corner in _row_corners(row, tiles.tolist())]
    ends = np.array(corners, np.float32).reshape(-1, 2) * (2 * TILE)
    return np.asarray(ends / (width, height) * (1, -1) + (-1, 1), np.float32)


def _row_corners(row: int, tiles: list[bool]) -> Iterator[tuple[int, int]]:
    """Yield two triangles for each run of covered tiles in a row, in tiles."""
    at = 0
    for is_covered, run in groupby(tiles):
        end = at + len(list(run))
        if is_covered:
            yield from ((at, row), (end, row), (end, row + 1), (at, row), (end, row + 1), (at, row + 1))
        at = end
