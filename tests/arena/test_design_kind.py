"""The kinds of designs: each of exactly one."""

import pytest

from mc_nested.arena.action import Cell
from mc_nested.arena.design_kind import BESIDE, CORNER, DIAGONAL, EDGE, SCATTERED, kind_of_design, neighbours
from mc_nested.arena.scenario_file import load_scenario


@pytest.mark.parametrize(("name", "kind"), [("line", EDGE), ("zigzag", CORNER), ("diamond", CORNER)])
def test_the_shipped_designs(name: str, kind: str) -> None:
    assert kind_of_design(load_scenario(name).design) == kind


@pytest.mark.parametrize(
    ("design", "kind"),
    [
        ({(3, 3)}, EDGE),
        ({(3, 3), (3, 4), (4, 4), (5, 4)}, EDGE),
        ({(3, 3), (3, 4), (4, 5), (4, 6)}, CORNER),
        ({(3, 3), (3, 4), (3, 6)}, SCATTERED),
        ({(3, 3), (4, 4), (6, 5)}, SCATTERED),
    ],
)
def test_edges_then_corners_then_nothing(design: set[Cell], kind: str) -> None:
    assert kind_of_design(design) == kind


def test_eight_cells_are_around_a_cell() -> None:
    around = neighbours((5, 5), (*BESIDE, *DIAGONAL))
    assert sorted(around) == [(x, y) for x in (4, 5, 6) for y in (4, 5, 6) if (x, y) != (5, 5)]
