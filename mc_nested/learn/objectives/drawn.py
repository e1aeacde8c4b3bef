"""What the agents with objectives train on: designs, and arenas in which something stands, drawn at random.

Designs are edge-connected, corner-connected or scattered, lines and outlines, several pieces, and with holes; from one
block to as many as fit. The row nearest to the player stays free: a block lands in front of the agent.
"""

from collections.abc import Sequence
from itertools import product

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arena.design import BESIDE, DIAGONAL, neighbours
from mc_nested.arrays import Bools

GROWN, DIAGONAL_ONLY, SCATTERED, LINES, PIECES = range(5)
"""Kinds of designs, each as likely."""

EVERY_STEP = (*BESIDE, *DIAGONAL)

MOST_SCATTERED = 40
MOST_TRIES = 6
"""For each block, before a design that can't grow is left as it is."""


def drawn_size(random: np.random.Generator, smallest: int, largest: int) -> int:
    """Return an arena's size: each equally likely, but the largest ones more often."""
    return int(random.integers(smallest, largest + 1)) if random.random() < 0.7 else largest - 1


def drawn_design(random: np.random.Generator, size: int, most_blocks: int) -> set[Cell]:
    """Return a design of one block at least for an arena of that size; of more than ``most_blocks`` one in five."""
    kind = int(random.integers(5))
    fit = size * (size - 1)
    most = min(fit, most_blocks) if random.random() < 0.8 else fit
    blocks = int(random.integers(1, most + 1))
    if kind == SCATTERED:
        cells = list(product(range(size), range(1, size)))
        return {cells[place] for place in random.permutation(fit)[: min(blocks, MOST_SCATTERED)]}
    pieces = int(random.integers(2, 5)) if kind == PIECES else 1
    steps = (BESIDE, DIAGONAL, (), BESIDE, EVERY_STEP)[kind]
    design: set[Cell] = set()
    for _ in range(pieces):
        design |= _piece(random, size, max(1, blocks // pieces), steps, is_line=kind == LINES)
    if kind == GROWN and random.random() < 0.3:
        design = _with_holes(random, design)
    return design


def _piece(random: np.random.Generator, size: int, blocks: int, steps: Sequence[Cell], *, is_line: bool) -> set[Cell]:
    """Return cells that grow from one: from any of them by a step, or in lines of up to five from the last."""
    grown = [(int(random.integers(size)), int(random.integers(1, size)))]
    found = set(grown)
    for _ in range(MOST_TRIES * blocks):
        if len(found) >= blocks:
            break
        cell = grown[-1 if is_line else int(random.integers(len(grown)))]
        step = steps[int(random.integers(len(steps)))]
        for _ in range(int(random.integers(1, 6)) if is_line else 1):
            (cell,) = neighbours(cell, (step,))
            if not (0 <= cell[0] < size and 1 <= cell[1] < size):
                break
            if cell not in found or is_line:
                grown.append(cell)
            found.add(cell)
    return found


def _with_holes(random: np.random.Generator, design: set[Cell]) -> set[Cell]:
    """Return the design without a fifth of its cells."""
    cells = sorted(design)
    holes = {cells[place] for place in random.permutation(len(cells))[: len(cells) // 5]}
    return design - holes


def drawn_obstacles(random: np.random.Generator, size: int, most_blocks: int) -> Bools:
    """Return where something stands in an arena of that size, (size, size): chance, walls, or a part of a design.

    Often nothing does; often all rows before one are free, as they are where the farthest were built first.
    """
    stands = np.zeros((size, size), np.bool_)
    if random.random() < 0.5:
        left_out = random.random()
        for x, y in sorted(drawn_design(random, size, most_blocks)):
            stands[x, y] = random.random() >= left_out
    elif random.random() < 0.7:
        stands = random.random((size, size)) < random.random() * 0.35
    if random.random() < 0.1:
        for _ in range(int(random.integers(1, 4))):
            _put_wall(random, stands)
    if random.random() < 0.3:
        stands[:, : int(random.integers(0, size))] = False
    return stands


def _put_wall(random: np.random.Generator, stands: Bools) -> None:
    size = len(stands)
    row, begins, length = int(random.integers(1, size)), int(random.integers(0, size)), int(random.integers(2, size))
    if random.random() < 0.5:
        stands[begins : begins + length, row] = True
    else:
        stands[row, begins : begins + length] = True
