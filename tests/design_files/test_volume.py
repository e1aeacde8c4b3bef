"""Volume: which cells have a block, and of which kind; impossible designs are refused before they are made."""

from collections import Counter

import numpy as np
import pytest

from mc_nested.design_files.volume import MOST_CELLS, Volume, block_name, check_size, volume_of
from mc_nested.errors import ScenarioError

PALETTE = ("air", "stone", "oak_stairs", "stone", "cave_air")
TWO_LAYERS = Volume(PALETTE, np.array([[[0, 4, 0], [0, 0, 4]], [[1, 2, 0], [3, 4, 0]]], np.int32))


def test_a_layer_holds_every_block_except_all_kinds_of_air() -> None:
    assert TWO_LAYERS.filled(1).tolist() == [[True, True, False], [True, False, False]]
    assert (TWO_LAYERS.layers, TWO_LAYERS.layers_with_blocks()) == (2, [1])


def test_blocks_of_one_name_are_counted_together() -> None:
    assert TWO_LAYERS.kinds(1) == Counter(stone=2, oak_stairs=1)
    assert TWO_LAYERS.kinds(0) == Counter()


def test_a_layers_extent_is_that_of_its_blocks() -> None:
    assert TWO_LAYERS.extent(1) == (2, 2)
    assert TWO_LAYERS.extent(0) == (0, 0)


@pytest.mark.parametrize(
    ("full", "name"),
    [
        ("minecraft:oak_stairs[facing=east,half=bottom]", "oak_stairs"),
        ("stone", "stone"),
        ("create:shaft[axis=x]", "create:shaft"),
        ("minecraft:\x1b[31mred\n", "?"),
        ("a\nb\x07", "a?b?"),
        ("", "?"),
        ("x" * 500, "x" * 60),
    ],
)
def test_a_blocks_name_is_short_and_can_be_printed(full: str, name: str) -> None:
    assert block_name(full) == name


@pytest.mark.parametrize("size", [(0, 3, 3), (3, -2, 3)])
def test_a_size_without_cells_is_refused(size: tuple[int, int, int]) -> None:
    with pytest.raises(ScenarioError, match="a design has at least one cell"):
        check_size(*size)


def test_a_size_of_too_many_cells_is_refused() -> None:
    assert check_size(256, 128, 256) == MOST_CELLS
    with pytest.raises(ScenarioError, match="its size is 257 x 128 x 256, 8,421,376 cells, and at most 8,388,608"):
        check_size(257, 128, 256)


@pytest.mark.parametrize(("numbers", "says"), [([0, 2], "number 2"), ([-1, 1], "number -1")])
def test_a_number_that_its_palette_lacks_is_refused(numbers: list[int], says: str) -> None:
    with pytest.raises(ScenarioError, match=f"a block is {says} of its palette, which has 2"):
        volume_of(np.array(numbers), ["air", "stone"], 1, 1, 2)
