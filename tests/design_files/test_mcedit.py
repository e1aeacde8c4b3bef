"""MCEdit's schematics: today's names of old numbers, and what doesn't fit together."""

from typing import Any

import pytest

from mc_nested.design_files.mcedit import is_mcedit, name_of, read_mcedit
from mc_nested.design_files.nbt import read_nbt
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, Short, mcedit, nbt_file


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
def test_an_old_number_has_todays_name(number: int, data: int, name: str) -> None:
    assert name_of(number, data) == name


def schematic(**changes: Any) -> bytes:
    """Three blocks in a row, of which the first and the last are mods' with the numbers 257 and 514."""
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
def test_the_first_of_two_blocks_has_the_high_bits_that_are_added(changes: dict[str, Any], names: list[str]) -> None:
    volume = read_mcedit(read_nbt(schematic(**changes)))
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
def test_what_does_not_fit_together_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_mcedit(read_nbt(schematic(**changes)))


def test_it_is_known_by_its_tags() -> None:
    assert is_mcedit(read_nbt(mcedit(HUT)))
    assert not is_mcedit(read_nbt(nbt_file({"Blocks": b""})))
