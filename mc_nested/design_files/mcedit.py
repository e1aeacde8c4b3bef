"""MCEdit's schematics (.schematic), of the versions before 1.13: a number for each block, and four bits of data.

``legacy_blocks.txt`` has the names of today: a number, and a name for each value of the data, from 0 on; data beyond
has the first name. They are taken from minecraft-data (MIT licence), https://github.com/PrismarineJS/minecraft-data.
"""

from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from mc_nested.design_files.nbt import Compound, value_of
from mc_nested.design_files.sponge import unsigned_short
from mc_nested.design_files.volume import Volume, check_size, volume_of
from mc_nested.errors import ScenarioError

DATA_BITS = 4


def is_mcedit(root: Compound) -> bool:
    """Whether a file's root is such a schematic's."""
    return "Blocks" in root and "Data" in root


def read_mcedit(root: Compound) -> Volume:
    """The schematic's blocks; ScenarioError, without the file's name, if they can't be read."""
    width, height, length = (unsigned_short(root, name) for name in ("Width", "Height", "Length"))
    cells = check_size(width, height, length)
    numbers = _bytes_in(root, "Blocks", cells).astype(np.int32) + _high_bits(root, cells)
    kinds, blocks = np.unique(
        numbers << DATA_BITS | _bytes_in(root, "Data", cells) & 0b1111,
        return_inverse=True,
    )
    names = [name_of(kind >> DATA_BITS, kind & 0b1111) for kind in kinds.tolist()]
    return volume_of(blocks.reshape(-1), names, height, length, width)


def name_of(number: int, data: int) -> str:
    """Today's name of an old number and its data; ``block number 300`` where the game had none."""
    names = _names().get(number)
    if names is None:
        return f"block number {number}"
    return names[data] if data < len(names) else names[0]


@cache
def _names() -> dict[int, list[str]]:
    text = (resources.files("mc_nested.design_files") / "legacy_blocks.txt").read_text("utf-8")
    return {int(number): names for number, *names in map(str.split, text.splitlines())}


def _bytes_in(root: Compound, name: str, cells: int) -> NDArray[np.uint8]:
    values = np.frombuffer(value_of(root, name, bytearray), np.uint8)
    if len(values) != cells:
        raise ScenarioError(f"it has {cells:,} cells, and {name} holds {len(values):,}: the file is damaged")
    return values


def _high_bits(root: Compound, cells: int) -> NDArray[np.int32]:
    """(cells,): what the tag ``AddBlocks`` adds to the numbers of mods' blocks; zeros without it.

    A byte is for two cells, its high bits for the first of them, as MCEdit writes it.
    """
    if "AddBlocks" not in root:
        return np.zeros(cells, np.int32)
    pairs = np.frombuffer(value_of(root, "AddBlocks", bytearray), np.uint8).astype(np.int32)
    if len(pairs) != (cells + 1) // 2:
        raise ScenarioError(f"it has {cells:,} cells, and AddBlocks is for {2 * len(pairs):,}: the file is damaged")
    return np.stack([pairs >> 4, pairs & 0b1111], axis=1).reshape(-1)[:cells] << 8
