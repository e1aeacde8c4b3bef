"""The game's structures: places that aren't listed, several palettes, and what doesn't fit together."""

from typing import Any

import pytest

from mc_nested.design_files.structure import is_structure, read_structure
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, nbt_file, read_nbt, states, structure


def saved(**changes: Any) -> bytes:
    """Return one block in a corner of 2 x 1 x 2 cells; a change to None leaves a tag out."""
    tags: dict[str, Any] = {"size": [2, 1, 2], "palette": states(["minecraft:stone"])}
    tags |= {"blocks": [{"pos": [1, 0, 0], "state": 0}], "entities": []} | changes
    return nbt_file({name: value for name, value in tags.items() if value is not None})


def test_a_place_that_is_not_listed_is_free() -> None:
    volume = read_structure(read_nbt(saved()))
    assert volume.filled(0).tolist() == [[False, True], [False, False]]


def test_the_first_of_several_palettes_is_taken() -> None:
    assert set(read_structure(read_nbt(structure(HUT, palettes=3))).kinds(0)) == {"stone", "oak_stairs"}


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"size": [2, 1]}, "size has 2 numbers, not x, y and z"),
        ({"size": [2, -1, 2]}, "its size is 2 x -1 x 2"),
        ({"size": [1000, 1000, 1000]}, "1,000,000,000 cells, and at most"),
        ({"size": ["a", "b", "c"]}, "size is not a whole number"),
        ({"blocks": [{"pos": [2, 0, 0], "state": 0}]}, r"a block at \(2, 0, 0\) lies outside its size"),
        ({"blocks": [{"pos": [0, -1, 0], "state": 0}]}, r"a block at \(0, -1, 0\) lies outside its size"),
        ({"blocks": [{"pos": [0, 0, 0], "state": 1}]}, "a block is number 1 of its palette, which has 1"),
        ({"blocks": [{"pos": [0, 0, 0], "state": -1}]}, "a block is number -1 of its palette"),
        ({"blocks": [{"pos": [0, 0, 0]}]}, "state is missing"),
        ({"blocks": [3]}, "blocks: an entry is not a compound"),
        ({"palette": None}, "palette is missing"),
        ({"palette": [3]}, "a palette's entry is not a compound"),
        ({"palettes": []}, "palettes: the first is missing"),
    ],
)
def test_an_inconsistent_structure_is_refused(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_structure(read_nbt(saved(**changes)))


def test_a_structure_is_recognised_by_its_tags() -> None:
    assert is_structure(read_nbt(structure(HUT)))
    assert not is_structure(read_nbt(nbt_file({"blocks": []})))
