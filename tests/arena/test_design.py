"""The kinds of designs: every design is of exactly one.

A scenario from a design alone: what it takes over, and its step limit.
"""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import SMALLEST_SIZE, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.design import (
    BESIDE,
    CORNER,
    DIAGONAL,
    EDGE,
    SCATTERED,
    is_buildable,
    kind_of_design,
    neighbours,
    scenario_of_design,
)
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.search import fewest_steps


@pytest.mark.parametrize(("name", "kind"), [("line", EDGE), ("zigzag", CORNER), ("diamond", CORNER)])
def test_the_papers_designs_are_of_known_kinds(name: str, kind: str) -> None:
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
def test_a_design_is_joined_by_edges_or_by_corners_or_scattered(design: set[Cell], kind: str) -> None:
    assert kind_of_design(design) == kind


def test_neighbours_returns_the_eight_cells_around_a_cell() -> None:
    around = neighbours((5, 5), (*BESIDE, *DIAGONAL))
    assert sorted(around) == [(x, y) for x in (4, 5, 6) for y in (4, 5, 6) if (x, y) != (5, 5)]


LINE = load_scenario("line")


def test_a_quickly_built_design_gets_the_shipped_designs_step_limit() -> None:
    for name in ("line", "zigzag"):
        shipped = load_scenario(name)
        assert scenario_of_design(name, shipped.design, LINE) == shipped


def test_a_slowly_built_design_gets_one_and_a_half_times_the_builders_steps_as_limit() -> None:
    far_apart = frozenset({(0, 1), (14, 1), (0, 14), (14, 14), (0, 7), (14, 7)})
    scenario = scenario_of_design("far", far_apart, LINE)
    assert scenario
    steps = len(build(scenario))
    assert steps > 40
    assert 1.5 * steps <= scenario.step_limit < 1.5 * steps + 1
    assert (scenario.start, scenario.materials) == (LINE.start, LINE.materials)


def test_a_design_that_the_builder_can_not_build_gives_no_scenario() -> None:
    # No block can land on the near edge: the builder walks against the arena's edge, and places it elsewhere.
    assert scenario_of_design("near", frozenset({(3, 0), (3, 1)}), LINE) is None
    assert not is_buildable(replace(LINE, step_limit=10))
    assert is_buildable(LINE)


@st.composite
def small_designs(draw: st.DrawFn) -> Scenario:
    """Return any design of a few blocks off the near edge, from any start, with no step limit to speak of."""
    size = draw(st.integers(SMALLEST_SIZE, 9))
    cells = st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))
    design = draw(st.frozensets(cells.filter(lambda cell: cell[1] > 0), min_size=1, max_size=7))
    return replace(LINE, size=size, design=design, start=draw(cells))


@given(small_designs())
def test_the_builder_takes_at_least_the_fewest_steps_and_at_most_the_step_limit(
    like: Scenario,
) -> None:
    scenario = scenario_of_design("any", like.design, like)
    assert scenario
    fewest = fewest_steps(scenario)
    assert fewest.exact
    assert fewest.steps <= len(build(scenario)) <= scenario.step_limit
