"""Random designs of one layer that nobody drew: a pure function of a seed and a number.

The kinds take turns, so that every kind has an equal share. The number of blocks is drawn first, each equally likely.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arena.design import BESIDE, CORNER, DIAGONAL, EDGE, KINDS, kind_of_design, neighbours, scenario_of_design
from mc_nested.arena.scenario import Scenario

FEW_BLOCKS = 5, 20
"""The fewest blocks of a design, and the most, unless others are asked for."""

GROWS_BY = {EDGE: BESIDE, CORNER: DIAGONAL}
"""Where the next block of a design that grows may stand, beside any of its blocks; scattered blocks stand anywhere."""


def random_scenario(seed: int, number: int, like: Scenario, blocks: tuple[int, int] = FEW_BLOCKS) -> Scenario:
    """Return design ``number`` of that seed; arena, start cell and materials are those of ``like``.

    ``blocks`` are the fewest that it may have, and the most.

    Drawn again until it is of its kind, and the scripted builder builds it within its step limit.
    """
    kind = KINDS[number % len(KINDS)]
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(number,))))
    while True:
        design = draw_design(kind, random, like.size, blocks)
        scenario = scenario_of_design(f"{kind}-{number:03d}", design, like)
        if kind_of_design(design) == kind and scenario:
            return scenario


def draw_design(kind: str, random: np.random.Generator, size: int, blocks: tuple[int, int]) -> frozenset[Cell]:
    """Return blocks of that kind, but scattered ones may touch by chance; from the fewest to the most.

    No block lies on the near edge, where none can land.
    """
    fewest, most = blocks
    wanted = int(random.integers(fewest, most + 1))
    cells = [(x, y) for x in range(size) for y in range(1, size)]
    if kind not in GROWS_BY:
        return frozenset(cells[place] for place in random.permutation(len(cells))[:wanted])
    return _grown(wanted, GROWS_BY[kind], cells, random)


def _grown(blocks: int, steps: Sequence[Cell], cells: Sequence[Cell], random: np.random.Generator) -> frozenset[Cell]:
    """Grow from one cell, each time into any free cell that is one of the steps away from a block."""
    design = {cells[int(random.integers(len(cells)))]}
    inside = set(cells)
    while len(design) < blocks:
        free = sorted({near for cell in design for near in neighbours(cell, steps) if near in inside} - design)
        design.add(free[int(random.integers(len(free)))])
    return frozenset(design)
