"""The scripted builder: every design to its optimum, by the rules, without wasting a block."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import LARGEST_SIZE, SMALLEST_SIZE, Cell
from mc_nested.arena.builder import build, build_with_materials, out_of_reach, within_reach
from mc_nested.arena.env import step_in
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import Material, Part, Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from tests.arena.simulated import arena_env


@pytest.mark.parametrize("name", shipped_scenarios())
def test_the_builder_reaches_the_optimum_within_the_step_limit(name: str) -> None:
    env = arena_env(name)
    env.reset()
    results = [env.step(step_in(env.scenario, *step)) for step in build_with_materials(env.scenario)]
    *_, (_, _, terminated, truncated, info) = results
    assert terminated
    assert not truncated
    assert info["score"] == env.scenario.optimum


@pytest.mark.parametrize("name", shipped_scenarios())
def test_a_policy_over_x_y_b_can_follow_the_builder(name: str) -> None:
    scenario = load_scenario(name)
    states = []
    cell, placed = scenario.start, set[Cell]()
    for action in build(scenario):
        states.append((*cell, scenario.blocks - len(placed)))
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        placed |= {block} if block else set()
    assert len(set(states)) == len(states)


@st.composite
def scenarios(draw: st.DrawFn) -> Scenario:
    """Return any design off the near edge, in an arena of any size, from any start."""
    size = draw(st.integers(SMALLEST_SIZE, LARGEST_SIZE))
    cells = st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))
    design = draw(st.frozensets(cells.filter(lambda cell: cell[1] > 0), min_size=1))
    return Scenario("any", design, draw(cells), size * size, (Material("stone", 0.0, "stone"),), size)


@given(scenarios())
def test_any_design_off_the_near_edge_is_built_from_anywhere(scenario: Scenario) -> None:
    cell, placed = scenario.start, set[Cell]()
    for action in build(scenario):
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        if block is not None:
            placed.add(block)
    assert placed == scenario.design


DRAWN = Scenario("drawn", frozenset({(1, 0), (1, 1), (3, 4)}), (2, 2), 20, (Material("stone", 0.0, "stone"),), 5)


def test_cells_of_the_nearest_row_are_out_of_reach_and_no_others() -> None:
    assert out_of_reach(DRAWN) == {(1, 0)}
    assert within_reach(DRAWN) == replace(DRAWN, design=frozenset({(1, 1), (3, 4)}))


def test_a_part_keeps_its_cells_in_reach_and_is_dropped_without_any() -> None:
    parts = tuple(Part(frozenset(cells), (0.0,)) for cells in ([(1, 0)], [(3, 4), (2, 0)], [(1, 1)]))
    drawn = replace(DRAWN, design=DRAWN.design | {(2, 0)}, parts=parts)
    assert [part.cells for part in within_reach(drawn).parts] == [{(3, 4)}, {(1, 1)}]


@given(scenarios())
def test_all_of_any_design_off_the_near_edge_is_in_reach(scenario: Scenario) -> None:
    assert within_reach(scenario) == scenario
