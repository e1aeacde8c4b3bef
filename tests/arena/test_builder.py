"""The scripted builder: every design to its optimum, by the rules, without wasting a block."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build
from mc_nested.arena.rules import SIZE, landing, moved
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from sim.grid import arena_env


@pytest.mark.parametrize("name", shipped_scenarios())
def test_the_builder_reaches_the_optimum_within_the_step_limit(name: str) -> None:
    env = arena_env(name)
    env.reset()
    results = [env.step(action) for action in build(env.scenario)]
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
        cell = moved(cell, action, placed)
        block = landing(cell, action, placed)
        placed |= {block} if block else set()
    assert len(set(states)) == len(states)


cells = st.tuples(st.integers(0, SIZE - 1), st.integers(1, SIZE - 1))


@given(design=st.frozensets(cells, min_size=1), start=st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1)))
@settings(max_examples=200)
def test_any_design_off_the_near_edge_is_built_from_anywhere(design: frozenset[Cell], start: Cell) -> None:
    scenario = Scenario("any", design, start, 225, (Material("stone", 0.0, "stone"),))
    cell, placed = start, set[Cell]()
    for action in build(scenario):
        cell = moved(cell, action, placed)
        block = landing(cell, action, placed)
        if block is not None:
            placed.add(block)
    assert placed == design
