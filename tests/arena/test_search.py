"""The fewest steps: known ones, a plain search over small designs, and never more than the builder's."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.search import EXACT_UP_TO, FewestSteps, fewest_steps
from tests.arena.made_parts import scenarios_with_parts


@pytest.mark.parametrize(("name", "steps"), [("line", 13), ("zigzag", 25), ("diamond", 38)])
def test_the_shipped_designs_take_the_known_fewest_steps(name: str, steps: int) -> None:
    assert fewest_steps(load_scenario(name)) == FewestSteps(steps, exact=True)


def test_a_design_too_large_for_the_exact_search_gets_the_builders_steps_as_bound() -> None:
    design = frozenset((x, 5) for x in range(15)) | {(x, 7) for x in range(EXACT_UP_TO - 14)}
    scenario = _scenario(design, (7, 14))
    assert fewest_steps(scenario) == FewestSteps(len(build(scenario)), exact=False)


def test_the_exact_search_covers_the_largest_arena() -> None:
    # Blocks in the two far corners: up along the right side, 30 steps, one block, and across, 31 steps.
    scenario = _scenario(frozenset({(31, 31), (0, 31)}), (31, 1), 32)
    assert fewest_steps(scenario) == FewestSteps(29 + 31, exact=True)


cells = st.tuples(st.integers(1, 5), st.integers(1, 5))


@given(
    design=st.frozensets(cells, min_size=1, max_size=3),
    start=cells,
    off=st.integers(0, 10),
    size=st.sampled_from([15, 16, 17, 32]),
)
def test_the_exact_search_agrees_with_a_plain_search(design: frozenset[Cell], start: Cell, off: int, size: int) -> None:
    # From the near left corner to the far right one, where a row of bits ends.
    shift = size - 6 if off > 5 else off
    design = frozenset((x + shift, y + shift) for x, y in design)
    scenario = _scenario(design, (start[0] + shift, start[1] + shift), size)
    found = fewest_steps(scenario)
    assert found == FewestSteps(_plain_search(scenario), exact=True)
    assert found.steps <= len(build(scenario))


@given(scenarios_with_parts())
def test_the_exact_search_agrees_with_a_plain_search_on_scenarios_with_parts(scenario: Scenario) -> None:
    found = fewest_steps(scenario)
    assert found == FewestSteps(_plain_search(scenario), exact=True)
    assert found.steps <= len(build(scenario))


def _scenario(design: frozenset[Cell], start: Cell, size: int = 15) -> Scenario:
    return Scenario("any", design, start, size * size, (Material("stone", 0.0, "stone"),), size)


def _plain_search(scenario: Scenario) -> int:
    frontier: set[tuple[Cell, frozenset[Cell]]] = {(scenario.start, frozenset())}
    seen = set(frontier)
    steps = 0
    while not any(placed == scenario.design for _, placed in frontier):
        steps += 1
        ahead = set()
        for cell, placed in frontier:
            now = scenario.in_order[scenario.part_at(scenario.blocks - len(placed))].cells
            for action in Action:
                stands = moved(cell, action, placed, scenario.size)
                block = landing(stands, action, placed, scenario.size)
                if block is None or block in now:
                    ahead.add((stands, placed | {block} if block else placed))
        frontier = ahead - seen
        seen |= frontier
    return steps
