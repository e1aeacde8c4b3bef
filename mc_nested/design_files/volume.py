"""Volume: the blocks of a design file, whatever format it came in. Layer 0 is the lowest."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Bools
from mc_nested.errors import ScenarioError

AIR = "air"

NOTHING = frozenset({AIR, "cave_air", "void_air", "structure_void"})
"""Names that count as no block: the three kinds of air, and what a structure block leaves as it is."""

MOST_CELLS = 8 * 1024 * 1024
"""Cells of a file: 256 x 128 x 256, far more than any design has."""

LONGEST_NAME = 60
"""Characters of a block's name that are kept."""


@dataclass(frozen=True, eq=False)
class Volume:
    """Blocks as indices into a palette.

    Args:
        palette: names without the namespace ``minecraft:`` and without states; several entries may have one name.
        blocks: (height, length, width), the lowest layer first; in a layer the northern row first, in a row the
            westernmost cell. As the game's axes: y, z, x.
    """

    palette: tuple[str, ...]
    blocks: NDArray[np.integer]

    @property
    def layers(self) -> int:
        """How many layers there are, empty ones too."""
        return len(self.blocks)

    @cached_property
    def solid(self) -> Bools:
        """(palette,): which entries are blocks."""
        return np.array([name not in NOTHING for name in self.palette], np.bool_)

    def filled(self, layer: int) -> Bools:
        """Return (length, width): where that layer has a block."""
        found: Bools = self.solid[self.blocks[layer]]
        return found

    def layers_with_blocks(self) -> list[int]:
        """Return the layers that have any block, the lowest first."""
        found: list[int] = np.flatnonzero(self.solid[self.blocks].any(axis=(1, 2))).tolist()
        return found

    def extent(self, layer: int) -> tuple[int, int]:
        """Return over how many cells a layer's blocks reach, from west to east and from north to south."""
        rows, columns = np.nonzero(self.filled(layer))
        return (int(np.ptp(columns)) + 1, int(np.ptp(rows)) + 1) if len(rows) else (0, 0)

    def kinds(self, layer: int) -> Counter[str]:
        """Return how many blocks of each name that layer has, without air."""
        counted = np.bincount(self.blocks[layer].reshape(-1), minlength=len(self.palette))
        kinds: Counter[str] = Counter()
        for name, count in zip(self.palette, counted.tolist(), strict=True):
            if name not in NOTHING and count:
                kinds[name] += count
        return kinds


def block_name(full: str) -> str:
    """Return ``oak_stairs`` of ``minecraft:oak_stairs[facing=east]``. What can't be printed becomes a question mark."""
    name = full.partition("[")[0].removeprefix("minecraft:")[:LONGEST_NAME]
    return "".join(character if character.isprintable() else "?" for character in name) or "?"


def check_size(width: int, height: int, length: int) -> int:
    """Return the cells of a volume of that size; ScenarioError where it has none, or more than any design."""
    if min(width, height, length) < 1:
        raise ScenarioError(f"its size is {width} x {height} x {length}: a design has at least one cell")
    cells = width * height * length
    if cells > MOST_CELLS:
        raise too_large_error(width, height, length)
    return cells


def too_large_error(width: int, height: int, length: int) -> ScenarioError:
    """Return the error for a volume of more cells than are read."""
    return ScenarioError(
        f"its size is {width} x {height} x {length}, {width * height * length:,} cells, and at most {MOST_CELLS:,} are "
        "read: save a smaller part of it"
    )


def volume_of(numbers: NDArray[np.integer], names: Sequence[str], height: int, length: int, width: int) -> Volume:
    """Return the volume whose blocks are ``numbers``, (cells,) in the order y, z, x.

    Raise ScenarioError if a kind has no name.
    """
    highest = int(numbers.max())
    lowest = int(numbers.min())
    if lowest < 0 or highest >= len(names):
        wrong = lowest if lowest < 0 else highest
        raise ScenarioError(f"a block is number {wrong} of its palette, which has {len(names)}: the file is damaged")
    return Volume(tuple(map(block_name, names)), numbers.reshape(height, length, width))
