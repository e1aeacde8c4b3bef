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
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from sim.grid import GridGame
from tests.arena.game_contract import BUMPS, check_following, check_game, check_materials
from tests.arena.made_parts import STRIPES, TO_FAR, TO_NEAR

LINE = load_scenario("line")


class ForgetsToReset(GridGame):
    def reset(self, material: int) -> Cell:
        start = LINE.start
        if self._cell == start:
            super().reset(material)
        return start


class StaysPut(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        before = self._cell
        return Outcome(before, super().act(action, material, following).placed)


class WalksThroughBlocks(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        placed, self._placed = self._placed, set()
        outcome = super().act(action, material, following)
        self._placed = placed | self._placed
        return outcome


class ClaimsBlocksThatDidNotLand(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        outcome = super().act(action, material, following)
        return Outcome(outcome.cell, (outcome.cell[0], outcome.cell[1] + 1))


class StartsElsewhere(GridGame):
    def reset(self, material: int) -> Cell:
        x, y = super().reset(material)
        return x, y - 1


class PlacesAgainAndAgain(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        outcome = super().act(action, material, following)
        self._placed -= {outcome.placed or (-1, -1)}
        return outcome


class PlacesBeforeItMoves(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        ahead = (self._cell[0], self._cell[1] + 1)
        outcome = super().act(action, material, following)
        return Outcome(outcome.cell, ahead if outcome.placed else None)


class WalksOutOfTheArena(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        outcome = super().act(action, material, following)
        x, y = outcome.cell
        return Outcome((x - (x == 0 and action is Action.L), y), outcome.placed)


class DoesWhatFollows(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        return super().act(following[0] if following else action, material)


class ForgetsItsBlocks(GridGame):
    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        super().restore({**snapshot, "game_placed": np.zeros((15, 15), np.bool_)})


class NeverLooks(GridGame):
    """A game that repeats the rules, and knows nothing of a world."""

    def truth(self) -> tuple[Cell, set[Cell]]:
        return LINE.start, set()


class NotesItsBlocks(GridGame):
    """A game that notes the material of each of its blocks."""

    def __init__(self, scenario: Scenario) -> None:
        super().__init__(scenario)
        self.in_hand, self.stands = 0, dict[Cell, str]()

    def reset(self, material: int) -> Cell:
        self.in_hand, self.stands = material, {}
        return super().reset(material)

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        self.take(material)
        outcome = super().act(action, material, following)
        if outcome.placed:
            self.stands[outcome.placed] = STRIPES.materials[self.in_hand].block
        return outcome

    def take(self, material: int | None) -> None:
        self.in_hand = self.in_hand if material is None else material


class NeverTakesAnother(NotesItsBlocks):
    def take(self, material: int | None) -> None:
        """Keep the material in hand."""


class TakesTheFirstAgain(NotesItsBlocks):
    def take(self, material: int | None) -> None:
        self.in_hand = material or 0


class KeepsItOverAReset(NotesItsBlocks):
    def reset(self, material: int) -> Cell:
        kept = self.in_hand
        start = super().reset(material)
        self.in_hand = kept
        return start


IN_BOTH = [(TO_FAR[0], 1), (TO_FAR[1], None), *((action, 0) for action in TO_NEAR)]


def test_the_simulator_and_a_game_that_notes_its_blocks_pass_the_materials_contract() -> None:
    check_materials(GridGame(STRIPES), STRIPES, IN_BOTH)
    game = NotesItsBlocks(STRIPES)
    check_materials(game, STRIPES, IN_BOTH, lambda: game.stands)


@pytest.mark.parametrize("liar", [NeverTakesAnother, TakesTheFirstAgain, KeepsItOverAReset])
def test_a_game_that_places_another_material_fails_the_contract(liar: Callable[..., NotesItsBlocks]) -> None:
    game = liar(STRIPES)
    steps = [(TO_FAR[0], None), *IN_BOTH[1:]] if liar is KeepsItOverAReset else IN_BOTH
    with pytest.raises(AssertionError, match="places what is in hand"):
        check_materials(game, STRIPES, steps, lambda: game.stands)


def test_the_simulator_passes_the_contract() -> None:
    check_game(GridGame(LINE), LINE, BUMPS)
    check_game(GridGame(LINE), LINE, build(LINE))


@given(st.lists(st.sampled_from(Action), max_size=80))
def test_the_simulator_passes_the_contract_over_any_actions(actions: list[Action]) -> None:
    check_game(GridGame(LINE), LINE, actions)


@given(st.lists(st.sampled_from(Action), max_size=80))
def test_the_simulator_does_the_same_whatever_follows(actions: list[Action]) -> None:
    check_following(GridGame(LINE), LINE, actions)


def test_a_game_that_does_what_only_follows_fails_the_contract() -> None:
    with pytest.raises(AssertionError, match="does the same, whatever follows"):
        check_following(DoesWhatFollows(LINE), LINE, BUMPS)


LIARS = [
    *(ForgetsToReset, StaysPut, WalksThroughBlocks, ClaimsBlocksThatDidNotLand),
    *(StartsElsewhere, PlacesAgainAndAgain, PlacesBeforeItMoves, WalksOutOfTheArena),
    ForgetsItsBlocks,
]


@pytest.mark.parametrize("liar", LIARS)
def test_a_game_with_wrong_outcomes_fails_the_contract(liar: Callable[..., GridGame]) -> None:
    with pytest.raises(AssertionError):
        check_game(liar(LINE), LINE, BUMPS)


def test_a_game_that_only_repeats_the_rules_fails_against_the_truth() -> None:
    game = NeverLooks(LINE)
    check_game(game, LINE, BUMPS)
    with pytest.raises(AssertionError, match="did what was said"):
        check_game(game, LINE, BUMPS, game.truth)
