"""Sponge schematics (.schem) of versions 1, 2 and 3: WorldEdit's, and most other programs'.

Blocks are variable-length integers, seven bits a byte, the lowest first; the highest bit says that more follow.
Source: https://github.com/SpongePowered/Schematic-Specification
"""

import numpy as np
from numpy.typing import NDArray

from mc_nested.design_files.nbt import Compound, checked, value_of
from mc_nested.design_files.volume import Volume, check_size, volume_of
from mc_nested.errors import ScenarioError

LONGEST = 4
"""Bytes of a block's number: 28 bits, more than any palette needs."""


def is_sponge(root: Compound) -> bool:
    """Whether a file's root is such a schematic's, of any version."""
    return "Schematic" in root or ("Palette" in root and "BlockData" in root)


def read_sponge(root: Compound) -> Volume:
    """The schematic's blocks; ScenarioError, without the file's name, if they can't be read."""
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
    """A size in cells: the format's shorts have no sign."""
    return value_of(compound, name, int) & 0xFFFF


def decoded(data: NDArray[np.uint8], cells: int) -> NDArray[np.int32]:
    """(cells,): the variable-length integers in the bytes; ScenarioError if there are fewer or more, or too long."""
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
