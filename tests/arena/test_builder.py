"""The scripted builder: every design to its optimum, by the rules, without wasting a block."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build, build_with_materials
from mc_nested.arena.env import step_in
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import LARGEST_SIZE, SMALLEST_SIZE, Material, Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from sim.grid import arena_env


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
