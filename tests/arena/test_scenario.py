"""Facts that follow from a scenario.

Parts: which is built when, what must hold of them, and the main agent's return.
"""

from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Material, Part, Scenario, main_return, regions_of
from mc_nested.errors import ScenarioError
from tests.arena.made_parts import FAR, NEAR, STRIPES

WOOD, STONE = Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")
CLAY = Material("clay", 10.0, "clay")
BAR = Scenario("bar", frozenset({(6, 12), (7, 12), (8, 12)}), (7, 13), 9, (WOOD, STONE, CLAY))


def test_a_scenario_has_a_block_per_cell_and_an_optimum_in_the_best_material() -> None:
    assert (BAR.blocks, BAR.start_state, BAR.optimum) == (3, (7, 13, 3), 13.0)


def test_the_first_of_several_best_materials_is_the_best_material() -> None:
    assert BAR.best_material == 1
    assert replace(BAR, materials=(WOOD,)).optimum == -2.0


def test_a_material_is_found_by_its_name_and_an_unknown_one_is_refused() -> None:
    assert BAR.material_index("clay") == 2
    with pytest.raises(ScenarioError, match="has no material 'gold': choose one of wood, stone, clay"):
        BAR.material_index("gold")


@pytest.mark.parametrize(
    ("count", "rows"),
    [
        (2, ["00011", "00011", "00011", "00011", "00011"]),
        (4, ["11133", "11133", "00022", "00022", "00022"]),
        (3, ["00112", "00112", "00112", "00112", "00112"]),
        (6, ["11335", "11335", "00224", "00224", "00224"]),
    ],
)
def test_an_arena_of_5_is_divided_into_regions_as_evenly_as_goes(count: int, rows: list[str]) -> None:
    found = regions_of(5, count)
    assert ["".join(str(found[x, y]) for x in range(5)) for y in reversed(range(5))] == rows


def test_as_many_regions_as_cells_are_the_cells() -> None:
    assert sorted(regions_of(15, 225).flatten().tolist()) == list(range(225))
    assert regions_of(15, 225)[0, 14] == 14, "column by column, from the near edge on"


def test_64_regions_of_an_arena_of_15_have_1_to_4_cells_each() -> None:
    _, cells = np.unique(regions_of(15, 64), return_counts=True)
    assert (len(cells), set(cells.tolist()), cells.sum()) == (64, {1, 2, 4}, 225)


def test_more_columns_of_regions_than_of_cells_are_refused() -> None:
    with pytest.raises(ScenarioError, match="regions: 5 columns of cells can't be 7 of regions"):
        replace(STRIPES, materials=(STONE,) * 7, parts=(), regions=True)


@pytest.mark.parametrize("size", [4, 33])
def test_an_arena_has_5_to_32_cells_a_side(size: int) -> None:
    replace(BAR, size=15)
    with pytest.raises(ScenarioError, match=f"{size} x {size} cells: an arena has 5 to 32 a side"):
        replace(BAR, size=size, design=frozenset({(1, 1)}), start=(0, 0))


@pytest.mark.parametrize("cell", [(15, 3), (3, 15), (-1, 3), (3, -1)])
def test_a_design_that_reaches_outside_its_arena_is_refused(cell: tuple[int, int]) -> None:
    with pytest.raises(ScenarioError, match=rf"cell \({cell[0]}, {cell[1]}\) lies outside the arena of 15 x 15 cells"):
        replace(BAR, design=BAR.design | {cell})
    if min(cell) >= 0:
        assert replace(BAR, design=BAR.design | {cell}, size=16).blocks == 4


@pytest.mark.parametrize("start", [(15, 3), (3, 15), (-1, 3), (3, -1)])
def test_a_start_outside_its_arena_is_refused(start: tuple[int, int]) -> None:
    with pytest.raises(ScenarioError, match="lies outside: choose 0 to 14 for x and y"):
        replace(BAR, start=start)


WORTH = (1.0, 2.0)


def test_the_current_part_follows_from_the_number_of_blocks_laid() -> None:
    assert [STRIPES.part_at(STRIPES.blocks - laid) for laid in range(6)] == [0, 0, 1, 1, 1, 1]
    assert [STRIPES.part_at(left) for left in (5, 4, 3, 1, 0)] == [0, 0, 1, 1, 1]


def test_a_scenario_without_parts_counts_as_one_part_with_the_materials_p() -> None:
    assert replace(STRIPES, parts=()).in_order == (Part(FAR | NEAR, (-5.0, 10.0)),)


def test_the_optimum_builds_each_part_in_its_best_material() -> None:
    assert STRIPES.optimum == 5 + 10 + 6
    assert (STRIPES.best_material, STRIPES.best_materials) == (1, (1, 0))


def test_the_main_agents_return_adds_paid_blocks_and_each_materials_share_of_p() -> None:
    # Both parts of an episode: one block of wood and one of stone in the first, two of three of stone in the second.
    laid = np.array([[[1, 1], [0, 2]]])
    worth = np.array([[[-5.0, 10.0], [6.0, -3.0]]])
    assert main_return(np.array([3]), laid, worth, np.array([[2, 3]])) == 3 + (-5 + 10) / 2 - 3 * 2 / 3


@pytest.mark.parametrize("p", [-5.0, 10.0, 0.1, 1 / 3])
def test_the_return_of_one_part_and_one_choice_is_the_papers(p: float) -> None:
    blocks, none = np.array([7]), np.array([[[7, 0]]])
    assert main_return(blocks, none, np.array([[[p, 99.0]]]), np.array([[7]])) == 7 + p


@pytest.mark.parametrize(
    ("parts", "problem"),
    [
        ((FAR, NEAR | {(1, 3)}), r"cell \(1, 3\) is in part 2 and in an earlier one: draw it in one"),
        ((FAR, NEAR - {(3, 2)}), r"cell \(3, 2\) of the design is in no part: draw it in one"),
        ((FAR, NEAR | {(4, 4)}), r"cell \(4, 4\) of part 2 is not in the design: draw it there, too"),
        ((FAR | NEAR, frozenset()), "part 2 has no block: draw at least one"),
    ],
)
def test_parts_that_overlap_or_do_not_cover_the_design_are_refused(
    parts: tuple[frozenset[Cell], ...], problem: str
) -> None:
    with pytest.raises(ScenarioError, match=f"^parts: {problem}$"):
        replace(STRIPES, parts=tuple(Part(cells, WORTH) for cells in parts))


def test_a_later_part_that_can_only_lower_the_score_is_refused() -> None:
    replace(STRIPES, parts=(Part(FAR, (-9.0, -9.0)), Part(NEAR, (-3.0, -9.0))))
    with pytest.raises(ScenarioError, match=r"^parts: part 2, built whole, brings at most -0\.5: raise a worth$"):
        replace(STRIPES, parts=(Part(FAR, WORTH), Part(NEAR, (-3.5, -9.0))))
