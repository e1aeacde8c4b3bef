"""Schematics of Sponge (.schem, versions 1, 2 and 3), which most programs write, and of MCEdit (.schematic).

Sponge's blocks are variable-length integers, seven bits a byte, the lowest first; the highest bit says that more
follow. Source: https://github.com/SpongePowered/Schematic-Specification

MCEdit, before 1.13, has a number for each block, and four bits of data. ``legacy_blocks.txt`` has today's names: a
number, then a name for each value of the data, from 0 on; higher values have the first name. They are taken from
minecraft-data (MIT licence), https://github.com/PrismarineJS/minecraft-data.
"""

from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from mc_nested.design_files.nbt import Compound, checked, value_of
from mc_nested.design_files.volume import Volume, check_size, volume_of
from mc_nested.errors import ScenarioError

LONGEST = 4
"""Bytes of a block's number: 28 bits, more than any palette needs."""


def is_sponge(root: Compound) -> bool:
    """Return whether a file's root is such a schematic's, of any version."""
    return "Schematic" in root or ("Palette" in root and "BlockData" in root)


def read_sponge(root: Compound) -> Volume:
    """Return the schematic's blocks; ScenarioError, without the file's name, if they can't be read."""
    schematic = value_of(root, "Schematic", dict) if "Schematic" in root else root
    version = value_of(schematic, "Version", int)
    if version not in (1, 2, 3):
        raise ScenarioError(f"a Sponge schematic of version {version}: save it as version 1, 2 or 3")
    if version == 3:
        blocks = value_of(schematic, "Blocks", dict)
        palette, data = value_of(blocks, "Palette", dict), value_of(blocks, "Data", bytearray)
    else:
        palette, data = value_of(schematic, "Palette", dict), value_of(schematic, "BlockData", bytearray)
    width, height, length = (unsigned_short(schematic, name) for name in ("Width", "Height", "Length"))
    numbers = decoded(np.frombuffer(data, np.uint8), check_size(width, height, length))
    names = {checked(tag, int, f"Palette: {name!r}"): name for name, tag in palette.items()}
    known = np.array(sorted(names), np.int64)
    places = np.searchsorted(known, numbers)
    unknown = (places == len(known)) | (known.take(places, mode="clip") != numbers) if len(known) else numbers >= 0
    if unknown.any():
        raise ScenarioError(f"a block is number {numbers[unknown][0]}, which its palette lacks: the file is damaged")
    return volume_of(places, [names[number] for number in sorted(names)], height, length, width)


def unsigned_short(compound: Compound, name: str) -> int:
    """Return a size in cells: the format's shorts have no sign."""
    return value_of(compound, name, int) & 0xFFFF


def decoded(data: NDArray[np.uint8], cells: int) -> NDArray[np.int32]:
    """Return the variable-length integers in the bytes, (cells,).

    Raise ScenarioError if there are fewer or more, or too long.
    """
    ends = np.flatnonzero(data < 0x80).astype(np.int32)
    if len(ends) != cells or (cells and ends[-1] != len(data) - 1):
        raise ScenarioError(f"it says that it has {cells:,} cells, and holds {len(ends):,} blocks: the file is damaged")
    starts = np.concatenate([np.zeros(1, np.int32), ends[:-1] + 1])
    lengths = ends - starts + 1
    if lengths.max() > LONGEST:
        raise ScenarioError("a block's number is longer than four bytes: the file is damaged")
    numbers = np.zeros(cells, np.int32)
    for byte in range(int(lengths.max())):
        longer = lengths > byte
        numbers[longer] |= (data[starts[longer] + byte].astype(np.int32) & 0x7F) << (7 * byte)
    return numbers


DATA_BITS = 4


def is_mcedit(root: Compound) -> bool:
    """Return whether a file's root is such a schematic's."""
    return "Blocks" in root and "Data" in root


def read_mcedit(root: Compound) -> Volume:
    """Return the schematic's blocks; ScenarioError, without the file's name, if they can't be read."""
    width, height, length = (unsigned_short(root, name) for name in ("Width", "Height", "Length"))
    cells = check_size(width, height, length)
    numbers = _bytes_in(root, "Blocks", cells).astype(np.int32) + _high_bits(root, cells)
    kinds, blocks = np.unique(numbers << DATA_BITS | _bytes_in(root, "Data", cells) & 0b1111, return_inverse=True)
    names = [name_of(kind >> DATA_BITS, kind & 0b1111) for kind in kinds.tolist()]
    return volume_of(blocks.reshape(-1), names, height, length, width)


def name_of(number: int, data: int) -> str:
    """Return today's name of an old number and its data; ``block number 300`` where the game had none."""
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
    """Return what the tag ``AddBlocks`` adds to the numbers of mods' blocks, (cells,); zeros without it.

    A byte is for two cells, its high bits for the first of them, as MCEdit writes it.
    """
    if "AddBlocks" not in root:
        return np.zeros(cells, np.int32)
    pairs = np.frombuffer(value_of(root, "AddBlocks", bytearray), np.uint8).astype(np.int32)
    if len(pairs) != (cells + 1) // 2:
        raise ScenarioError(f"it has {cells:,} cells, and AddBlocks is for {2 * len(pairs):,}: the file is damaged")
    return np.stack([pairs >> 4, pairs & 0b1111], axis=1).reshape(-1)[:cells] << 8
