"""The game's own structures (.nbt), as a structure block saves them: a list of blocks with their places.

A place that isn't listed is left as it is where the structure is loaded: no block of the design.
Source: https://minecraft.wiki/w/Structure_file
"""

from typing import Any

import numpy as np

from mc_nested.design_files.nbt import Compound, checked, value_of
from mc_nested.design_files.volume import AIR, Volume, check_size, volume_of
from mc_nested.errors import ScenarioError


def is_structure(root: Compound) -> bool:
    """Return whether a file's root is a structure's."""
    return "size" in root and "blocks" in root


def read_structure(root: Compound) -> Volume:
    """Return the structure's blocks, by its first palette.

    Raise ScenarioError, without the file's name, if they can't be read.
    """
    width, height, length = _three(root, "size")
    check_size(width, height, length)
    names = palette_names(_palette(root))
    numbers = np.zeros((height, length, width), np.int32)
    for tag in value_of(root, "blocks", list):
        block = checked(tag, dict, "blocks: an entry")
        x, y, z = _three(block, "pos")
        if not (0 <= x < width and 0 <= y < height and 0 <= z < length):
            raise ScenarioError(f"a block at ({x}, {y}, {z}) lies outside its size: the file is damaged")
        state = value_of(block, "state", int)
        if not 0 <= state < len(names):
            raise ScenarioError(
                f"a block is number {state} of its palette, which has {len(names)}: the file is damaged"
            )
        numbers[y, z, x] = state + 1
    return volume_of(numbers.reshape(-1), [AIR, *names], height, length, width)


def palette_names(palette: list[Any]) -> list[str]:
    """Return the names in a list of block states, as structures and Litematica have it."""
    return [value_of(checked(tag, dict, "a palette's entry"), "Name", str) for tag in palette]


def _palette(root: Compound) -> list[Any]:
    """Return the palette; of several, of which the game takes one by chance, the first."""
    if "palettes" not in root:
        return value_of(root, "palette", list)
    palettes = value_of(root, "palettes", list)
    return checked(palettes[0] if palettes else None, list, "palettes: the first")


def _three(compound: Compound, name: str) -> tuple[int, int, int]:
    numbers = [checked(tag, int, name) for tag in value_of(compound, name, list)]
    if len(numbers) != 3:
        raise ScenarioError(f"{name} has {len(numbers)} numbers, not x, y and z: the file is damaged")
    return numbers[0], numbers[1], numbers[2]
