"""Who builds, and from where."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Cell
from mc_nested.arena.cooperative.team import Team, spread_starts, team_of
from mc_nested.arena.scenario import SMALLEST_SIZE
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import ScenarioError

LINE = load_scenario("line")


@pytest.mark.parametrize(
    ("builders", "starts"),
    [
        (1, ((7, 14),)),
        (2, ((7, 14), (14, 14))),
        (3, ((7, 14), (12, 14), (2, 14))),
        (4, ((7, 14), (10, 14), (14, 14), (3, 14))),
    ],
)
def test_builders_begin_spread_along_the_row_of_the_scenarios_start(builders: int, starts: tuple[Cell, ...]) -> None:
    assert spread_starts(LINE, builders) == starts
    assert team_of(LINE, builders).builders == builders


@given(st.integers(SMALLEST_SIZE, 32), st.integers(1, 4), st.data())
def test_every_builder_has_a_cell_of_its_own_in_any_arena(size: int, builders: int, data: st.DataObject) -> None:
    cells = st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))
    scenario = dataclasses.replace(LINE, size=size, design=frozenset({(0, 1)}), start=data.draw(cells))
    starts = team_of(scenario, builders).starts
    assert starts[0] == scenario.start
    assert len(set(starts)) == builders


@pytest.mark.parametrize("builders", [0, 5])
def test_an_arena_takes_one_to_four(builders: int) -> None:
    with pytest.raises(ScenarioError, match=f"^{builders} builders: an arena takes 1 to 4$"):
        team_of(LINE, builders)


def test_two_builders_never_start_on_one_cell() -> None:
    with pytest.raises(ScenarioError, match=r"^builders 0 and 2 both start on cell \(7, 14\): give each a cell of its"):
        Team(LINE, ((7, 14), (3, 3), (7, 14)))


def test_nobody_starts_outside() -> None:
    with pytest.raises(ScenarioError, match=r"^builder 1 starts on \(15, 0\), outside: choose 0 to 14 for x and y$"):
        Team(LINE, ((7, 14), (15, 0)))


def test_a_team_builds_a_design_without_parts() -> None:
    with pytest.raises(ScenarioError, match=r"^scenario flag has parts: several builders take one without$"):
        team_of(load_scenario("flag"), 2)
