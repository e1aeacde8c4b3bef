"""Sponge schematics: numbers of any length, palettes with gaps, and what doesn't fit together.

MCEdit's schematics: today's names of old numbers, and what doesn't fit together.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.design_files.schematic import decoded, is_mcedit, is_sponge, name_of, read_mcedit, read_sponge
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, Short, mcedit, nbt_file, read_nbt, sponge, varint


@given(st.lists(st.integers(0, 2**28 - 1), min_size=1))
def test_numbers_of_any_length_are_decoded(numbers: list[int]) -> None:
    data = np.frombuffer(b"".join(map(varint, numbers)), np.uint8)
    assert decoded(data, len(numbers)).tolist() == numbers


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"\1", "it says that it has 2 cells, and holds 1 blocks"),
        (b"\1\1\1", "it says that it has 2 cells, and holds 3 blocks"),
        (b"\1\1\x80", "it says that it has 2 cells, and holds 2 blocks"),
        (b"", "holds 0 blocks"),
        (b"\1\x80\x80\x80\x80\1", "a block's number is longer than four bytes"),
    ],
)
def test_block_data_that_does_not_fit_the_cells_is_refused(data: bytes, says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        decoded(np.frombuffer(data, np.uint8), 2)


def sponge_schematic(**changes: Any) -> bytes:
    """Return two blocks of a palette with gaps; a change to None leaves a tag out."""
    palette = {"minecraft:air": 4, "minecraft:stone": 900}
    tags: dict[str, Any] = {"Version": 2, "Width": Short(2), "Height": Short(1), "Length": Short(1)}
    tags |= {"Palette": palette, "BlockData": varint(900) + varint(4)} | changes
    return nbt_file({name: value for name, value in tags.items() if value is not None}, "Schematic")


def test_a_palettes_numbers_may_have_gaps() -> None:
    volume = read_sponge(read_nbt(sponge_schematic()))
    assert [volume.palette[number] for number in volume.blocks.reshape(-1)] == ["stone", "air"]


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"Version": 4}, "a Sponge schematic of version 4: save it as version 1, 2 or 3"),
        ({"Version": None}, "Version is missing"),
        ({"Palette": {"minecraft:air": 4}}, "a block is number 900, which its palette lacks"),
        ({"Palette": {}}, "a block is number 900, which its palette lacks"),
        ({"Palette": {"minecraft:air": -1, "minecraft:stone": 2**31 - 1}}, "a block is number 900"),
        ({"Palette": {"minecraft:air": "four"}}, "Palette: 'minecraft:air' is not a whole number"),
        ({"Width": Short(-1)}, "it says that it has 65,535 cells, and holds 2 blocks"),
        ({"Width": Short(0)}, "its size is 0 x 1 x 1"),
        ({"Width": Short(-1), "Height": Short(-1)}, "4,294,836,225 cells, and at most 8,388,608 are read"),
        ({"BlockData": "none"}, "BlockData is not an array of bytes"),
    ],
)
def test_an_inconsistent_sponge_schematic_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_sponge(read_nbt(sponge_schematic(**changes)))


@pytest.mark.parametrize("version", [1, 2, 3])
def test_a_sponge_schematic_is_recognised_by_its_tags(version: int) -> None:
    assert is_sponge(read_nbt(sponge(HUT, version)))
    assert not is_sponge(read_nbt(nbt_file({"Palette": {}})))


@pytest.mark.parametrize(
    ("number", "data", "name"),
    [
        (0, 0, "air"),
        (1, 0, "stone"),
        (1, 6, "polished_andesite"),
        (5, 1, "spruce_planks"),
        (35, 14, "red_wool"),
        (35, 15, "black_wool"),
        (53, 7, "oak_stairs"),
        (17, 4, "oak_log"),
        (17, 5, "spruce_log"),
        (251, 11, "blue_concrete"),
        (255, 0, "structure_block"),
        (253, 0, "block number 253"),
        (300, 2, "block number 300"),
    ],
)
def test_an_old_block_number_gets_todays_name(number: int, data: int, name: str) -> None:
    assert name_of(number, data) == name


def mcedit_schematic(**changes: Any) -> bytes:
    """Return three blocks in a row, of which the first and the last are mods' with the numbers 257 and 514."""
    tags: dict[str, Any] = {"Width": Short(3), "Height": Short(1), "Length": Short(1), "Materials": "Alpha"}
    tags |= {"Blocks": b"\1\1\2", "Data": b"\0\2\0", "AddBlocks": b"\x10\x20"} | changes
    return nbt_file({name: value for name, value in tags.items() if value is not None}, "Schematic")


@pytest.mark.parametrize(
    ("changes", "names"),
    [
        ({}, ["block number 257", "polished_granite", "block number 514"]),
        ({"AddBlocks": None}, ["stone", "polished_granite", "grass_block"]),
        ({"AddBlocks": b"\x01\0"}, ["stone", "block number 257", "grass_block"]),
        ({"AddBlocks": None, "Data": b"\xf0\xf1\xf2"}, ["stone", "granite", "grass_block"]),
    ],
)
def test_each_byte_of_addblocks_holds_the_high_bits_of_two_blocks(changes: dict[str, Any], names: list[str]) -> None:
    volume = read_mcedit(read_nbt(mcedit_schematic(**changes)))
    assert [volume.palette[number] for number in volume.blocks.reshape(-1)] == names


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"Blocks": b"\1\1"}, "it has 3 cells, and Blocks holds 2"),
        ({"Data": b"\0" * 4}, "it has 3 cells, and Data holds 4"),
        ({"AddBlocks": b"\0"}, "it has 3 cells, and AddBlocks is for 2"),
        ({"Height": None}, "Height is missing"),
        ({"Data": 3}, "Data is not an array of bytes"),
    ],
)
def test_an_inconsistent_mcedit_schematic_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_mcedit(read_nbt(mcedit_schematic(**changes)))


def test_an_mcedit_schematic_is_recognised_by_its_tags() -> None:
    assert is_mcedit(read_nbt(mcedit(HUT)))
    assert not is_mcedit(read_nbt(nbt_file({"Blocks": b""})))
