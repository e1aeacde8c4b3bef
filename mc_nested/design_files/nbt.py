"""NBT from a file that can't be trusted: sizes are limited before memory is allocated, and types are checked.

pynbt, which is an extra, trusts every length in the file. So it reads from a stream that hands out no byte which
isn't there and no more than so many values, and the stream's bytes were unpacked up to a limit.

A file whose stated size is too large is refused at once: decoding it first takes seconds. A size is a tag of a known
name and form, wherever it stands in the file: programs write a schematic's tags in any order.
"""

import gzip
import io
import re
import struct
import zlib
from collections.abc import Iterator
from typing import Any, TypeVar

from mc_nested.design_files.volume import MOST_CELLS, too_large_error
from mc_nested.errors import ScenarioError, with_extra

MOST_BYTES = 32 * 1024 * 1024
"""Bytes of a file, and of what it unpacks to."""

MOST_READS = 1_500_000
"""Reads of pynbt: it makes three for a number with a name, and twelve for a block of a structure, of which the game
saves 48 x 48 x 48. All together they take at most some hundred megabytes."""

GZIP, COMPOUND = b"\x1f\x8b", b"\x0a"
"""How a file begins: compressed, or as plain NBT."""

BEDROCK_TAGS = ((3, b"format_version"), (9, b"structure_world_origin"))
"""The types and names of two tags that each of Bedrock Edition's structures has."""

Compound = dict[str, Any]
"""pynbt's tags by name. Read their values with ``value_of``: pynbt has no types."""

Value = TypeVar("Value")

KINDS: dict[type, str] = {
    int: "a whole number",
    str: "a text",
    bytearray: "an array of bytes",
    tuple: "an array of numbers",
    list: "a list",
    dict: "a compound",
}
"""The Python type of each tag's value, in words."""


def root_of(plain: bytes, most_reads: int = MOST_READS) -> Compound:
    """Return the root compound of unpacked NBT; pynbt may read at most ``most_reads`` times.

    Raise ScenarioError, without the file's name, if it has none, lies nested too deeply, or there is no pynbt.
    """
    try:
        import pynbt
    except ImportError:
        raise ScenarioError(f"reading schematics needs pynbt: {with_extra('schematics')}") from None
    stream = _BoundedStream(plain, most_reads)
    try:
        root: Compound = pynbt.NBTFile(stream)
    except RecursionError:
        raise ScenarioError("its values lie nested too deeply: no design is saved like that") from None
    except (struct.error, IndexError, OSError, ValueError) as error:
        raise ScenarioError("its NBT can't be read: it is damaged, or not of Minecraft Java Edition") from error
    return root


def is_bedrock(plain: bytes) -> bool:
    """Return whether unpacked NBT is a structure of Bedrock Edition, whose numbers have their lowest byte first."""
    return plain.startswith(COMPOUND) and any(
        struct.pack("<BH", kind, len(name)) + name in plain for kind, name in BEDROCK_TAGS
    )


def unpacked(data: bytes) -> bytes:
    """Return the NBT in a file's bytes; ScenarioError if it is none, is damaged, or unpacks to more than MOST_BYTES."""
    if data.startswith(COMPOUND):
        return data
    if not data.startswith(GZIP):
        raise ScenarioError("it is no schematic, neither compressed with gzip nor plain NBT: name another file")
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(data)) as file:
            plain = file.read(MOST_BYTES + 1)
    except EOFError:
        raise ScenarioError("it ends in the middle: copy, or download, it again") from None
    except (gzip.BadGzipFile, zlib.error) as error:
        raise ScenarioError("it is damaged, gzip can't unpack it: copy, or download, it again") from error
    if len(plain) > MOST_BYTES:
        raise ScenarioError(f"it unpacks to more than {MOST_BYTES // 2**20} MB: save a smaller part of it")
    return plain


def value_of(compound: Compound, name: str, kind: type[Value]) -> Value:
    """Return the value of a tag, of that Python type (KINDS); ScenarioError if it is missing, or something else."""
    return checked(compound.get(name), kind, name)


def checked(tag: Any, kind: type[Value], name: str) -> Value:
    """Return the value of a tag of pynbt's, of that type.

    Raise ScenarioError, which calls it ``name``, if it is something else.
    """
    value = getattr(tag, "value", None)
    if not isinstance(value, kind):
        state = "is missing" if tag is None else f"is not {KINDS[kind]}"
        raise ScenarioError(f"{name} {state}: the file is damaged, or of a kind that is not known here")
    return value


class _BoundedStream:
    """What pynbt reads from: only bytes that are there, and only so many times."""

    def __init__(self, data: bytes, most_reads: int) -> None:
        self._data = data
        self._at = 0
        self._reads_left = most_reads

    def read(self, size: int) -> bytes:
        self._reads_left -= 1
        if self._reads_left < 0:
            raise ScenarioError("it holds more values than any design: save a smaller part of it")
        if size < 0:
            size += 1 << 16  # a text's length has no sign, and pynbt reads it with one
        if size < 0 or size > len(self._data) - self._at:
            raise ScenarioError("it ends in the middle of a value: copy, or download, it again")
        self._at += size
        return self._data[self._at - size : self._at]


SMALL_BYTES = 1 << 18
"""Unpacked bytes up to which the check gains nothing: they are decoded quickly."""

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
    """Raise ScenarioError, without the file's name, if unpacked NBT states more cells or blocks than are read."""
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
    """Yield width, height and length of Litematica's regions, of a structure, of Sponge's and MCEdit's schematics."""
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
