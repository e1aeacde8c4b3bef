"""Who builds, and from where; who acts first within a tick, and what stops whom."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import SMALLEST_SIZE, Action, Cell
from mc_nested.arena.cooperative.team import Team, resolved, spread_starts, team_of
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import landing, moved
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
def test_builders_start_on_distinct_cells_in_any_arena(size: int, builders: int, data: st.DataObject) -> None:
    cells = st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))
    scenario = dataclasses.replace(LINE, size=size, design=frozenset({(0, 1)}), start=data.draw(cells))
    starts = team_of(scenario, builders).starts
    assert starts[0] == scenario.start
    assert len(set(starts)) == builders


@pytest.mark.parametrize("builders", [0, 5])
def test_an_arena_takes_one_to_four_builders(builders: int) -> None:
    with pytest.raises(ScenarioError, match=f"^{builders} builders: an arena takes 1 to 4$"):
        team_of(LINE, builders)


def test_two_builders_that_start_on_one_cell_are_refused() -> None:
    with pytest.raises(ScenarioError, match=r"^builders 0 and 2 both start on cell \(7, 14\): give each a cell of its"):
        Team(LINE, ((7, 14), (3, 3), (7, 14)))


def test_a_start_outside_the_arena_is_refused() -> None:
    with pytest.raises(ScenarioError, match=r"^builder 1 starts on \(15, 0\), outside: choose 0 to 14 for x and y$"):
        Team(LINE, ((7, 14), (15, 0)))


def test_a_scenario_with_parts_is_refused_for_several_builders() -> None:
    with pytest.raises(ScenarioError, match=r"^scenario flag has parts: several builders take one without$"):
        team_of(load_scenario("flag"), 2)


F, B, L, R, FD, LD, RD, BD = Action
SIZE = 15


def tick(
    cells: list[Cell], actions: list[Action | None], placed: set[Cell] | None = None, left: int = 9
) -> tuple[Outcome, ...]:
    return resolved(cells, placed or set(), actions, SIZE, left)


def test_nobody_moves_into_a_builders_cell() -> None:
    assert tick([(3, 3), (4, 3)], [R, F]) == (Outcome((3, 3), None), Outcome((4, 4), None))


def test_a_cell_left_by_a_builder_of_lower_number_is_free_in_the_same_tick() -> None:
    assert tick([(4, 3), (3, 3)], [F, R]) == (Outcome((4, 4), None), Outcome((4, 3), None))


def test_the_builder_of_lower_number_gets_a_cell_that_two_builders_want() -> None:
    assert tick([(3, 3), (5, 3)], [R, L]) == (Outcome((4, 3), None), Outcome((5, 3), None))


def test_two_neighbours_never_change_places() -> None:
    assert tick([(3, 3), (4, 3)], [R, L]) == (Outcome((3, 3), None), Outcome((4, 3), None))


def test_no_block_lands_on_a_builder_but_the_move_is_done() -> None:
    assert tick([(3, 3), (4, 4)], [RD, None]) == (Outcome((4, 3), None), Outcome((4, 4), None))


def test_a_block_of_a_builder_of_lower_number_stops_the_others_in_the_same_tick() -> None:
    assert tick([(3, 4), (4, 4)], [BD, L]) == (Outcome((3, 3), (3, 4)), Outcome((4, 4), None))
    assert tick([(4, 4), (3, 4)], [L, BD]) == (Outcome((4, 4), None), Outcome((3, 3), (3, 4)))


def test_a_builder_stopped_by_another_still_places_a_block() -> None:
    assert tick([(3, 3), (3, 4)], [None, BD]) == (Outcome((3, 3), None), Outcome((3, 4), (3, 5)))


@pytest.mark.parametrize(("left", "second"), [(2, (9, 5)), (1, None)])
def test_builders_share_the_blocks_left(left: int, second: Cell | None) -> None:
    assert tick([(3, 5), (9, 5)], [BD, BD], left=left) == (Outcome((3, 4), (3, 5)), Outcome((9, 4), second))


def test_a_builder_with_none_as_action_does_nothing() -> None:
    assert tick([(3, 3)], [None]) == (Outcome((3, 3), None),)


@given(st.lists(st.sampled_from(Action), max_size=60))
def test_a_builder_alone_follows_the_rules_of_one_agent(actions: list[Action]) -> None:
    cell, placed = (7, 14), set[Cell]()
    for action in actions:
        (outcome,) = resolved([cell], placed, [action], SIZE, 99)
        cell = moved(cell, action, placed, SIZE)
        assert outcome == Outcome(cell, landing(cell, action, placed, SIZE))
        if outcome.placed is not None:
            placed.add(outcome.placed)


@given(st.lists(st.tuples(*[st.sampled_from(Action)] * 3), max_size=60))
def test_builders_and_blocks_never_share_a_cell(ticks: list[tuple[Action, Action, Action]]) -> None:
    cells, placed = [(2, 2), (3, 2), (2, 3)], set[Cell]()
    for actions in ticks:
        outcomes = resolved(cells, placed, actions, 5, 12 - len(placed))
        cells = [outcome.cell for outcome in outcomes]
        landed = [outcome.placed for outcome in outcomes if outcome.placed is not None]
        assert len(set(landed)) == len(landed)
        assert not placed.intersection(landed)
        placed |= set(landed)
        assert len(set(cells)) == 3
        assert not placed.intersection(cells)
    assert len(placed) <= 12
