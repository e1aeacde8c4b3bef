"""What follows from a scenario's facts."""

from dataclasses import replace

import pytest

from mc_nested.arena.scenario import Material, Scenario
from mc_nested.errors import ScenarioError

WOOD, STONE = Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")
CLAY = Material("clay", 10.0, "clay")
BAR = Scenario("bar", frozenset({(6, 12), (7, 12), (8, 12)}), (7, 13), 9, (WOOD, STONE, CLAY))


def test_there_is_a_block_for_each_cell_and_the_optimum_is_all_of_them_in_the_best_material() -> None:
    assert (BAR.blocks, BAR.start_state, BAR.optimum) == (3, (7, 13, 3), 13.0)


def test_of_materials_that_are_worth_the_same_the_first_is_the_best() -> None:
    assert BAR.best_material == 1
    assert replace(BAR, materials=(WOOD,)).optimum == -2.0


def test_a_material_is_found_by_its_name_and_an_unknown_one_is_refused() -> None:
    assert BAR.material_index("clay") == 2
    with pytest.raises(ScenarioError, match="has no material 'gold': choose one of wood, stone, clay"):
        BAR.material_index("gold")


@pytest.mark.parametrize("size", [4, 33])
def test_an_arena_has_5_to_32_cells_a_side(size: int) -> None:
    replace(BAR, size=15)
    with pytest.raises(ScenarioError, match=f"{size} x {size} cells: an arena has 5 to 32 a side"):
        replace(BAR, size=size, design=frozenset({(1, 1)}), start=(0, 0))


@pytest.mark.parametrize("cell", [(15, 3), (3, 15), (-1, 3), (3, -1)])
def test_a_design_larger_than_its_arena_is_refused_whoever_makes_it(cell: tuple[int, int]) -> None:
    with pytest.raises(ScenarioError, match=rf"cell \({cell[0]}, {cell[1]}\) lies outside the arena of 15 x 15 cells"):
        replace(BAR, design=BAR.design | {cell})
    if min(cell) >= 0:
        assert replace(BAR, design=BAR.design | {cell}, size=16).blocks == 4


@pytest.mark.parametrize("start", [(15, 3), (3, 15), (-1, 3), (3, -1)])
def test_a_start_outside_its_arena_is_refused_whoever_makes_it(start: tuple[int, int]) -> None:
    with pytest.raises(ScenarioError, match="lies outside: choose 0 to 14 for x and y"):
        replace(BAR, start=start)
