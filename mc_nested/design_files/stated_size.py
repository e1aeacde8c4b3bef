"""The sizes that a schematic states, found without decoding it: a file that is too large is refused at once.

Decoding one first takes seconds. A size is a tag of a known name and form, wherever it stands in the file: programs
write a schematic's tags in any order.
"""

import re
import struct
from collections.abc import Iterator

from mc_nested.design_files.nbt import MOST_READS
from mc_nested.design_files.volume import MOST_CELLS, too_large_error
from mc_nested.errors import ScenarioError

SMALL_BYTES = 1 << 18
"""Unpacked bytes that are decoded so quickly that nothing is gained."""

READS_A_BLOCK = 12
"""Reads of pynbt for a block that a structure lists, at least."""

_NUMBER = rb"\x03\x00\x01([xyz])(.{4})"
_CORNER = re.compile(rb"\x0a\x00\x04Size" + 3 * _NUMBER, re.DOTALL)
_THREE = re.compile(rb"\x09\x00\x04size\x03\x00\x00\x00\x03(.{12})", re.DOTALL)
_SIDES = tuple(
    re.compile(rb"\x02\x00" + bytes([len(name)]) + name + rb"(.{2})", re.DOTALL)
    for name in (b"Width", b"Height", b"Length")
)
_LISTED = re.compile(rb"\x09\x00\x06blocks\x0a(.{4})", re.DOTALL)


def check_stated_size(plain: bytes) -> None:
    """ScenarioError, without the file's name, if unpacked NBT states more cells or blocks than are read."""
    if len(plain) <= SMALL_BYTES:
        return
    for width, height, length in _sizes(plain):
        if width * height * length > MOST_CELLS:
            raise too_large_error(width, height, length)
    most = MOST_READS // READS_A_BLOCK
    for listed in _LISTED.findall(plain):
        (blocks,) = struct.unpack(">i", listed)
        if blocks > most:
            raise ScenarioError(f"it lists {blocks:,} blocks, and at most {most:,} are read: save a smaller part of it")


def _sizes(plain: bytes) -> Iterator[tuple[int, int, int]]:
    """Width, height and length: of Litematica's regions, of a structure, of Sponge's and MCEdit's schematics."""
    for found in _CORNER.finditer(plain):
        by_axis = dict(zip(found.groups()[::2], found.groups()[1::2], strict=True))
        if len(by_axis) == 3:
            x, y, z = (abs(struct.unpack(">i", by_axis[axis])[0]) for axis in (b"x", b"y", b"z"))
            yield x, y, z
    for found in _THREE.finditer(plain):
        x, y, z = struct.unpack(">3i", found[1])
        if min(x, y, z) > 0:
            yield x, y, z
    sides = [side.search(plain) for side in _SIDES]
    if all(sides):
        width, height, length = (struct.unpack(">H", side[1])[0] for side in sides if side)
        yield width, height, length
