"""Files by litemapy, which writes three of the formats with an NBT package of its own: read as they were written."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from litemapy import BlockState, Region, Schematic

from mc_nested.design_files.load import load_any_scenario, read_volume

STATES = [
    BlockState("minecraft:air"),
    BlockState("minecraft:stone"),
    BlockState("minecraft:oak_stairs", facing="east", half="bottom"),
    BlockState("minecraft:oak_stairs", facing="west", half="top"),
    *(BlockState(f"some_mod:part_{number}") for number in range(30)),
]
"""More than 32 kinds: six bits each in a .litematic."""

Cells = dict[tuple[int, int, int], str]
"""The name of each cell's block, by x, y and z."""


def filled(size: tuple[int, int, int], kinds: int, low: tuple[int, int, int] = (0, 0, 0)) -> tuple[Any, Cells]:
    """Return a region of random blocks, and their names from its lowest corner on; its size may be negative."""
    region = Region(*low, *size)
    random = np.random.default_rng(kinds)
    starts = [min(0, along + 1) for along in size]
    names: Cells = {}
    for x, y, z in np.ndindex(*map(abs, size)):
        state = STATES[int(random.integers(kinds))]
        region[x + starts[0], y + starts[1], z + starts[2]] = state
        names[x, y, z] = state.id.removeprefix("minecraft:")
    return region, names


def read(path: Path) -> Cells:
    volume = read_volume(path)
    return {(x, y, z): volume.palette[volume.blocks[y, z, x]] for y, z, x in np.ndindex(volume.blocks.shape)}


@pytest.mark.parametrize("size", [(5, 4, 7), (-5, 4, 7), (5, -4, -7), (-1, -1, -1), (16, 2, 33)])
@pytest.mark.parametrize("kinds", [1, 2, 4, 5, len(STATES)])
def test_a_litematic_of_one_region_by_litemapy_is_read(size: tuple[int, int, int], kinds: int, tmp_path: Path) -> None:
    region, names = filled(size, kinds, (3, -60, 8))
    Schematic(regions={"all": region}).save(str(tmp_path / "one.litematic"))
    assert read(tmp_path / "one.litematic") == names


def test_regions_of_a_litematic_by_litemapy_keep_their_positions(tmp_path: Path) -> None:
    one, names = filled((4, 2, 3), 4, (10, 5, -7))
    other, others = filled((-2, -2, -2), 4, (15, 6, -3))
    Schematic(regions={"one": one, "other": other}).save(str(tmp_path / "two.litematic"))
    found = read(tmp_path / "two.litematic")
    # The other region's lowest corner is (14, 5, -4): four cells to the east and three to the south of the first one's.
    expected = names | {(x + 4, y, z + 3): name for (x, y, z), name in others.items()}
    assert {cell: name for cell, name in found.items() if cell in expected} == expected
    assert {name for cell, name in found.items() if cell not in expected} == {"air"}
    assert len(found) == 6 * 2 * 5


WRITTEN: dict[str, Callable[[Any], Any]] = {
    "litemapy.nbt": lambda region: region.to_structure_nbt(),
    "litemapy.schem": lambda region: region.to_sponge_nbt(),
}


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("size", [(5, 4, 7), (1, 1, 1), (16, 2, 33)])
def test_structures_and_sponge_schematics_by_litemapy_are_read(
    name: str, size: tuple[int, int, int], tmp_path: Path
) -> None:
    region, names = filled(size, len(STATES))
    WRITTEN[name](region).save(str(tmp_path / name))
    assert read(tmp_path / name) == names


def test_a_layer_of_a_litematic_becomes_the_scenario_that_was_drawn(tmp_path: Path) -> None:
    region = Region(0, 0, 0, 5, 3, 3)
    for x, z in ((0, 0), (4, 0), (2, 1), (1, 2)):
        region[x, 1, z] = STATES[1]
    Schematic(regions={"dots": region}).save(str(tmp_path / "dots.litematic"))
    scenario = load_any_scenario(tmp_path / "dots.litematic").scenario
    assert scenario.name == "dots-1"
    assert scenario.design == {(5, 8), (9, 8), (7, 7), (6, 6)}
