"""Small design files of every format, written here byte by byte, to test the readers with.

A drawing is layers of rows of characters, the lowest layer first; PALETTE says what each is. NBT is written from Python
values: a dict is a compound, an int an int, bytes an array of bytes, and so on (``payload``).
"""

import gzip
import io
import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from PIL import Image

from mc_nested.design_files.nbt import MOST_READS, Compound, root_of, unpacked

Drawing = Sequence[Sequence[str]]

PALETTE = {
    ".": "minecraft:air",
    "s": "minecraft:stone",
    "o": "minecraft:oak_stairs[facing=east,half=bottom]",
    "w": "minecraft:oak_stairs[facing=west,half=bottom]",
    "c": "create:shaft",
}

NAMES = {".": "air", "s": "stone", "o": "oak_stairs", "w": "oak_stairs", "c": "create:shaft"}
"""What a reader calls each character's block."""

HUT: Drawing = [
    ["ssss", "s.os", "ssss"],
    ["s..s", "....", "swcs"],
    ["....", ".cc.", "...."],
    ["....", "....", "...."],
]
"""Three of its four layers have blocks; 4 x 3 cells."""


@dataclass(frozen=True)
class Short:
    value: int


@dataclass(frozen=True)
class Longs:
    values: Sequence[int]


NUMBERS: dict[type, int] = {Short: 2, int: 3, bytes: 7, str: 8, list: 9, dict: 10, Longs: 12}


def payload(value: Any) -> bytes:
    """Return a value as NBT, without its type and name."""
    match value:
        case Short():
            data = struct.pack(">H", value.value & 0xFFFF)
        case int():
            data = struct.pack(">i", value)
        case str():
            data = text(value)
        case bytes():
            data = struct.pack(">i", len(value)) + value
        case Longs():
            data = struct.pack(f">i{len(value.values)}q", len(value.values), *value.values)
        case list():
            kind = NUMBERS[type(value[0])] if value else 0
            data = struct.pack(">bi", kind, len(value)) + b"".join(map(payload, value))
        case _:
            data = b"".join(named(key, each) for key, each in value.items()) + b"\0"
    return data


def text(value: str) -> bytes:
    encoded = value.encode()
    return struct.pack(">H", len(encoded)) + encoded


def named(name: str, value: Any) -> bytes:
    return bytes([NUMBERS[type(value)]]) + text(name) + payload(value)


def nbt_file(root: Mapping[str, Any], name: str = "") -> bytes:
    """Return a whole file, compressed; the same bytes each time."""
    return gzip.compress(named(name, dict(root)), mtime=0)


def sizes(drawing: Drawing) -> tuple[int, int, int]:
    """Return width, height and length."""
    return len(drawing[0][0]), len(drawing), len(drawing[0])


def cells(drawing: Drawing) -> str:
    """Return every character, in the order y, z, x."""
    return "".join(row for layer in drawing for row in layer)


def varint(number: int) -> bytes:
    found = b""
    while number > 0x7F:
        found += bytes([number & 0x7F | 0x80])
        number >>= 7
    return found + bytes([number])


def sponge(drawing: Drawing, version: int = 2, first: int = 0) -> bytes:
    """Return a .schem whose palette's numbers begin with ``first``."""
    width, height, length = sizes(drawing)
    numbers = {character: first + index for index, character in enumerate(PALETTE)}
    palette = {PALETTE[character]: number for character, number in numbers.items()}
    data = b"".join(varint(numbers[character]) for character in cells(drawing))
    common = {"Version": version, "Width": Short(width), "Height": Short(height), "Length": Short(length)}
    if version == 3:
        return nbt_file({"Schematic": {**common, "DataVersion": 3465, "Blocks": {"Palette": palette, "Data": data}}})
    return nbt_file({**common, "PaletteMax": len(palette), "Palette": palette, "BlockData": data}, "Schematic")


LEGACY = {".": (0, 0), "s": (1, 0), "o": (53, 0), "w": (53, 1), "c": (300, 2)}
"""Number and data of each character's block before 1.13; 300 is a mod's."""


def mcedit(drawing: Drawing) -> bytes:
    """Return a .schematic, with AddBlocks where a number needs it."""
    width, height, length = sizes(drawing)
    blocks = [LEGACY[character] for character in cells(drawing)]
    root: dict[str, Any] = {
        "Width": Short(width),
        "Height": Short(height),
        "Length": Short(length),
        "Materials": "Alpha",
        "Blocks": bytes(number & 0xFF for number, _ in blocks),
        "Data": bytes(data for _, data in blocks),
    }
    if any(number > 0xFF for number, _ in blocks):
        high = [number >> 8 for number, _ in blocks] + [0]
        root["AddBlocks"] = bytes(high[at] << 4 | high[at + 1] for at in range(0, len(blocks), 2))
    return nbt_file(root, "Schematic")


def states(names: Sequence[str]) -> list[dict[str, Any]]:
    """Return a list of block states, as structures and Litematica have it."""
    return [{"Name": name.partition("[")[0]} for name in names]


def packed(numbers: Sequence[int], bits: int) -> Longs:
    """Return the numbers as one long number of bits, cut into longs with a sign."""
    whole = sum(number << bits * at for at, number in enumerate(numbers))
    bytes_needed = -(-len(numbers) * bits // 64) * 8
    return Longs(struct.unpack(f"<{bytes_needed // 8}q", whole.to_bytes(bytes_needed, "little")))


def region(drawing: Drawing, low: tuple[int, int, int] = (0, 0, 0), backwards: str = "") -> dict[str, Any]:
    """Return a region whose lowest corner is ``low``, given from its far end along the axes named in ``backwards``."""
    position, size = {}, {}
    for axis, start, cells_along in zip("xyz", low, sizes(drawing), strict=True):
        position[axis] = start + cells_along - 1 if axis in backwards else start
        size[axis] = -cells_along if axis in backwards else cells_along
    kinds = list(PALETTE)
    return {
        "Position": position,
        "Size": size,
        "BlockStatePalette": states(list(PALETTE.values())),
        "BlockStates": packed([kinds.index(character) for character in cells(drawing)], 3),
    }


def litematic(regions: Mapping[str, dict[str, Any]]) -> bytes:
    return nbt_file({"Version": 6, "MinecraftDataVersion": 3465, "Metadata": {}, "Regions": dict(regions)})


def structure(drawing: Drawing, palettes: int = 0) -> bytes:
    """Return a structure without its air; with ``palettes`` many of them, of which only the first has these names."""
    width, height, length = sizes(drawing)
    kinds = list(PALETTE)
    blocks = [
        {"pos": [x, y, z], "state": kinds.index(character)}
        for y, layer in enumerate(drawing)
        for z, row in enumerate(layer)
        for x, character in enumerate(row)
        if character != "."
    ]
    names = states(list(PALETTE.values()))
    others = [states(["minecraft:gold_block"] * len(names)) for _ in range(palettes - 1)]
    palette = {"palettes": [names, *others]} if palettes else {"palette": names}
    return nbt_file({"DataVersion": 3465, "size": [width, height, length], **palette, "blocks": blocks})


COLOURS = {".": (255, 255, 255, 255), "s": (90, 90, 90, 255), "o": (150, 110, 60, 255), "c": (200, 0, 0, 200)}


def picture(layer: Sequence[str], mode: str = "RGBA") -> bytes:
    """Return a .png of one layer, in a mode of Pillow's."""
    pixels = np.array([[COLOURS[character] for character in row] for row in layer], np.uint8)
    file = io.BytesIO()
    Image.fromarray(pixels).convert(mode, dither=Image.Dither.NONE).save(file, "PNG")
    return file.getvalue()


WRITERS: dict[str, Callable[[Drawing], bytes]] = {
    "sponge1.schem": lambda drawing: sponge(drawing, 1),
    "sponge2.schem": sponge,
    "sponge3.schem": lambda drawing: sponge(drawing, 3, first=200),
    "mcedit.schematic": mcedit,
    "litematica.litematic": lambda drawing: litematic({"all": region(drawing, (3, -2, 7), "xz")}),
    "structure.nbt": structure,
    "structures.nbt": lambda drawing: structure(drawing, palettes=2),
}
"""How each kind of file is written, by a name for it."""


def read_nbt(data: bytes, most_reads: int = MOST_READS) -> Compound:
    """Return the root compound of a file's bytes, compressed or not."""
    return root_of(unpacked(data), most_reads)
