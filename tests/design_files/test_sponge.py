"""Sponge schematics: numbers of any length, palettes with gaps, and what doesn't fit together."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.design_files.nbt import read_nbt
from mc_nested.design_files.sponge import decoded, is_sponge, read_sponge
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, Short, nbt_file, sponge, varint


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
def test_blocks_that_are_not_as_many_as_the_cells_are_refused(data: bytes, says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        decoded(np.frombuffer(data, np.uint8), 2)


def schematic(**changes: Any) -> bytes:
    """Two blocks of a palette with gaps; a change to None leaves a tag out."""
    palette = {"minecraft:air": 4, "minecraft:stone": 900}
    tags: dict[str, Any] = {"Version": 2, "Width": Short(2), "Height": Short(1), "Length": Short(1)}
    tags |= {"Palette": palette, "BlockData": varint(900) + varint(4)} | changes
    return nbt_file({name: value for name, value in tags.items() if value is not None}, "Schematic")


def test_a_palettes_numbers_may_have_gaps() -> None:
    volume = read_sponge(read_nbt(schematic()))
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
def test_what_does_not_fit_together_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_sponge(read_nbt(schematic(**changes)))


@pytest.mark.parametrize("version", [1, 2, 3])
def test_it_is_known_by_its_tags(version: int) -> None:
    assert is_sponge(read_nbt(sponge(HUT, version)))
    assert not is_sponge(read_nbt(nbt_file({"Palette": {}})))
