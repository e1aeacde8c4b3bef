"""Litematica's schematics: numbers that span two longs, regions that overlap or reach backwards."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.design_files.litematic import CHUNK, is_litematic, read_litematic, unpacked_numbers
from mc_nested.design_files.volume import Volume
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, Longs, litematic, nbt_file, packed, read_nbt, region


def names_in(volume: Volume) -> list[list[list[str]]]:
    """Return the blocks' names, layer by layer and row by row."""
    return [[[volume.palette[number] for number in row] for row in layer] for layer in volume.blocks.tolist()]


@given(st.integers(2, 20), st.data())
def test_numbers_of_any_width_are_unpacked(bits: int, data: st.DataObject) -> None:
    numbers = data.draw(st.lists(st.integers(0, 2**bits - 1), min_size=1, max_size=200))
    longs = np.array(packed(numbers, bits).values, np.int64).view(np.uint64)
    first = data.draw(st.integers(0, len(numbers)))
    assert unpacked_numbers(longs, bits, first, len(numbers) - first).tolist() == numbers[first:]


def test_a_region_larger_than_one_chunk_is_read_whole() -> None:
    rows = ["s." * 150 + "o"] * (CHUNK // 301 + 2)
    (layer,) = names_in(read_litematic(read_nbt(litematic({"all": region([rows])}))))
    assert layer == [["stone", "air"] * 150 + ["oak_stairs"]] * len(rows)


@pytest.mark.parametrize("backwards", ["", "x", "y", "z", "xyz"])
def test_a_region_given_from_any_end_is_read_the_same(backwards: str) -> None:
    one = region([["ss", "s.", "o."]], (4, 0, -9), backwards)
    other = region([["cc"]], (4, 1, -7))
    assert names_in(read_litematic(read_nbt(litematic({"a": one, "b": other})))) == [
        [["stone", "stone"], ["stone", "air"], ["oak_stairs", "air"]],
        [["air", "air"], ["air", "air"], ["create:shaft", "create:shaft"]],
    ]


def test_blocks_of_a_later_overlapping_region_win_but_its_air_does_not() -> None:
    regions = {"low": region([["sss"]]), "over": region([["o.c"]], (1, 0, 0))}
    assert names_in(read_litematic(read_nbt(litematic(regions)))) == [
        [["stone", "oak_stairs", "stone", "create:shaft"]],
    ]


def test_a_palette_of_one_kind_still_takes_two_bits_a_block() -> None:
    alone = region([["...."]]) | {"BlockStatePalette": [{"Name": "minecraft:stone"}], "BlockStates": Longs([0])}
    assert names_in(read_litematic(read_nbt(litematic({"all": alone})))) == [[["stone"] * 4]]


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"BlockStates": Longs([])}, "a region needs 3 longs for its blocks, and has 0"),
        ({"BlockStates": Longs([-1, -1, -1])}, "a block is number 7 of its palette, which has 5"),
        ({"BlockStatePalette": []}, "of its palette, which has 0"),
        ({"BlockStatePalette": [{"Properties": {}}]}, "Name is missing"),
        ({"Size": {"x": 0, "y": 1, "z": 1}}, "its size is 0 x 1 x 1"),
        ({"Size": {"x": -(2**31), "y": 2**31 - 1, "z": 1}}, "cells, and at most 8,388,608 are read"),
        ({"Size": {"x": 1, "y": 1}}, "z is missing"),
        ({"Position": [1, 2, 3]}, "Position is not a compound"),
        ({"BlockStates": b"\0" * 24}, "BlockStates is not an array of numbers"),
    ],
)
def test_an_inconsistent_region_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_litematic(read_nbt(litematic({"all": region(HUT) | changes})))


def test_regions_too_far_apart_or_too_large_together_are_refused() -> None:
    far = litematic({"here": region([["s"]]), "there": region([["s"]], (2**31 - 1, 0, 0))})
    with pytest.raises(ScenarioError, match="its size is 2147483648 x 1 x 1"):
        read_litematic(read_nbt(far))
    large = region([["s"]]) | {"Size": {"x": 2**12, "y": 1, "z": 2**10}, "BlockStatePalette": [{"Name": "stone"}]}
    large["BlockStates"] = Longs([0] * (2**22 * 2 // 64))
    with pytest.raises(ScenarioError, match="its regions have more than 8,388,608 cells together"):
        read_litematic(read_nbt(litematic({"a": large, "b": large, "c": large})))


def test_a_file_without_regions_is_refused() -> None:
    with pytest.raises(ScenarioError, match="it has no region"):
        read_litematic(read_nbt(litematic({})))


def test_a_litematic_is_recognised_by_its_tags() -> None:
    assert is_litematic(read_nbt(litematic({})))
    assert not is_litematic(read_nbt(nbt_file({"Metadata": {}})))
