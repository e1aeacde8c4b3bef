"""The contract suite: the simulator passes it, and Games with wrong outcomes don't."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario_file import load_scenario
from sim.grid import GridGame
from tests.arena.game_contract import BUMPS, check_game

LINE = load_scenario("line")


class ForgetsToReset(GridGame):
    def reset(self, material: int) -> Cell:
        start = LINE.start
        if self._cell == start:
            super().reset(material)
        return start


class StaysPut(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        before = self._cell
        return Outcome(before, super().act(action, material).placed)


class WalksThroughBlocks(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        placed, self._placed = self._placed, set()
        outcome = super().act(action, material)
        self._placed = placed | self._placed
        return outcome


class ClaimsBlocksThatDidNotLand(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        outcome = super().act(action, material)
        return Outcome(outcome.cell, (outcome.cell[0], outcome.cell[1] + 1))


class StartsElsewhere(GridGame):
    def reset(self, material: int) -> Cell:
        x, y = super().reset(material)
        return x, y - 1


class PlacesAgainAndAgain(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        outcome = super().act(action, material)
        self._placed -= {outcome.placed or (-1, -1)}
        return outcome


class PlacesBeforeItMoves(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        ahead = (self._cell[0], self._cell[1] + 1)
        outcome = super().act(action, material)
        return Outcome(outcome.cell, ahead if outcome.placed else None)


class WalksOutOfTheArena(GridGame):
    def act(self, action: Action, material: int | None = None) -> Outcome:
        outcome = super().act(action, material)
        x, y = outcome.cell
        return Outcome((x - (x == 0 and action is Action.L), y), outcome.placed)


class ForgetsItsBlocks(GridGame):
    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        super().restore({**snapshot, "game_placed": np.zeros((15, 15), np.bool_)})


class NeverLooks(GridGame):
    """Says what the rules say, and knows nothing of a world."""

    def truth(self) -> tuple[Cell, set[Cell]]:
        return LINE.start, set()


def test_the_simulator_passes() -> None:
    check_game(GridGame(LINE), LINE, BUMPS)
    check_game(GridGame(LINE), LINE, build(LINE))


@given(st.lists(st.sampled_from(Action), max_size=80))
def test_the_simulator_passes_over_any_actions(actions: list[Action]) -> None:
    check_game(GridGame(LINE), LINE, actions)


LIARS = [
    *(ForgetsToReset, StaysPut, WalksThroughBlocks, ClaimsBlocksThatDidNotLand),
    *(StartsElsewhere, PlacesAgainAndAgain, PlacesBeforeItMoves, WalksOutOfTheArena),
    ForgetsItsBlocks,
]


@pytest.mark.parametrize("liar", LIARS)
def test_a_game_with_wrong_outcomes_fails(liar: Callable[..., GridGame]) -> None:
    with pytest.raises(AssertionError):
        check_game(liar(LINE), LINE, BUMPS)


def test_a_game_that_returns_the_rules_instead_of_its_world_fails_against_the_truth() -> None:
    game = NeverLooks(LINE)
    check_game(game, LINE, BUMPS)
    with pytest.raises(AssertionError, match="did what was said"):
        check_game(game, LINE, BUMPS, game.truth)
