"""Litematica's schematics (.litematic): regions, each with a palette, and the blocks as numbers of so many bits.

The numbers are packed without gaps into longs, the lowest bits first, and may span two of them. A region may reach
from its position backwards: its size is negative then. Regions are put together as they lie to one another; where they
overlap, a later one's blocks stand.
Source: https://github.com/maruohon/litematica, LitematicaSchematic and LitematicaBitArray.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mc_nested.design_files.nbt import Compound, checked, value_of
from mc_nested.design_files.structure import palette_names
from mc_nested.design_files.volume import AIR, MOST_CELLS, Volume, check_size, volume_of
from mc_nested.errors import ScenarioError

Corner = tuple[int, int, int]
"""x, y and z of a block, relative to the schematic's."""


CHUNK = 1 << 16
"""Numbers unpacked at once, which takes some bytes for each."""


@dataclass(frozen=True)
class _Region:
    low: Corner
    blocks: Volume

    @property
    def high(self) -> Corner:
        """The first corner beyond it."""
        height, length, width = self.blocks.blocks.shape
        return self.low[0] + width, self.low[1] + height, self.low[2] + length


def is_litematic(root: Compound) -> bool:
    """Return whether a file's root is such a schematic's."""
    return "Regions" in root


def read_litematic(root: Compound) -> Volume:
    """Return all regions' blocks together; ScenarioError, without the file's name, if they can't be read."""
    tags = value_of(root, "Regions", dict)
    regions: list[_Region] = []
    for name, tag in tags.items():
        regions.append(_region(checked(tag, dict, f"region {name!r}")))
        if sum(region.blocks.blocks.size for region in regions) > MOST_CELLS:
            raise ScenarioError(f"its regions have more than {MOST_CELLS:,} cells together: save a smaller part of it")
    if not regions:
        raise ScenarioError("it has no region: save one that holds your design")
    return regions[0].blocks if len(regions) == 1 else _together(regions)


def _region(tag: Compound) -> _Region:
    position, size = (_corner(value_of(tag, name, dict)) for name in ("Position", "Size"))
    width, height, length = map(abs, size)
    cells = check_size(width, height, length)
    names = palette_names(value_of(tag, "BlockStatePalette", list))
    bits = max(2, (len(names) - 1).bit_length())
    longs = np.array(value_of(tag, "BlockStates", tuple), np.int64).view(np.uint64)
    needed = -(-cells * bits // 64)
    if len(longs) < needed:
        raise ScenarioError(f"a region needs {needed:,} longs for its blocks, and has {len(longs):,}: it is damaged")
    chunks = range(0, cells, CHUNK)
    numbers = np.concatenate([unpacked_numbers(longs, bits, at, min(CHUNK, cells - at)) for at in chunks])
    low = (
        position[0] + min(0, size[0] + 1),
        position[1] + min(0, size[1] + 1),
        position[2] + min(0, size[2] + 1),
    )
    return _Region(low, volume_of(numbers, names, height, length, width))


def _corner(tag: Compound) -> Corner:
    return value_of(tag, "x", int), value_of(tag, "y", int), value_of(tag, "z", int)


def unpacked_numbers(longs: NDArray[np.uint64], bits: int, first: int, count: int) -> NDArray[np.int32]:
    """Return the packed numbers from number ``first`` on, (count,), of so many bits each. The longs must hold them."""
    at = np.arange(first, first + count, dtype=np.uint64) * np.uint64(bits)
    word, shift = (at >> np.uint64(6)).astype(np.int64), at & np.uint64(63)
    numbers = longs[word] >> shift
    spans = shift > 64 - bits
    numbers[spans] |= longs[word[spans] + 1] << (np.uint64(64) - shift[spans])
    masked: NDArray[np.int32] = (numbers & np.uint64((1 << bits) - 1)).astype(np.int32)
    return masked


def _together(regions: list[_Region]) -> Volume:
    low = tuple(min(region.low[axis] for region in regions) for axis in range(3))
    high = tuple(max(region.high[axis] for region in regions) for axis in range(3))
    width, height, length = (high[axis] - low[axis] for axis in range(3))
    check_size(width, height, length)
    palette = [AIR]
    blocks = np.zeros((height, length, width), np.int32)
    for region in regions:
        x, y, z = (region.low[axis] - low[axis] for axis in range(3))
        tall, long, wide = region.blocks.blocks.shape
        part = blocks[y : y + tall, z : z + long, x : x + wide]
        np.copyto(part, region.blocks.blocks + len(palette), where=region.blocks.solid[region.blocks.blocks])
        palette += region.blocks.palette
    return Volume(tuple(palette), blocks)
