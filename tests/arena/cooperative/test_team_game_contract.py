"""The contract suite for teams: the simulator passes it, and TeamGames with wrong outcomes don't."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.game import Outcome
from mc_nested.arena.scenario_file import load_scenario
from sim.team_grid import TeamGrid
from tests.arena.cooperative.team_game_contract import check_team_game

LINE = load_scenario("line")
BESIDE = Team(LINE, ((7, 14), (6, 14)))
F, B, L, R, FD, LD, RD, BD = Action
TICKS = [(R, R), (L, L), (L, R), (B, B), (BD, BD), (R, L), (LD, RD), (F, F), (None, L), (L, None), (BD, BD), (FD, FD)]


class LetsThemWalkThroughEachOther(TeamGrid):
    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        alone = [TeamGrid(Team(LINE, (cell,))) for cell in self._cells]
        outcomes = [game.act([action])[0] for game, action in zip(alone, actions, strict=True)]
        self._cells = tuple(outcome.cell for outcome in outcomes)
        return tuple(outcomes)


class ActsInAnotherOrder(TeamGrid):
    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        self._cells = self._cells[::-1]
        outcomes = super().act(actions[::-1])[::-1]
        self._cells = self._cells[::-1]
        return outcomes


class StartsElsewhere(TeamGrid):
    def reset(self, material: int) -> tuple[Cell, ...]:
        return super().reset(material)[::-1]


class ForgetsItsBlocks(TeamGrid):
    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        super().restore({**snapshot, "team_game_placed": np.zeros((15, 15), np.bool_)})


def test_the_simulator_passes_the_team_contract() -> None:
    check_team_game(TeamGrid(BESIDE), BESIDE, TICKS)


@given(st.integers(1, 4), st.data())
def test_the_simulator_passes_the_team_contract_over_any_actions(builders: int, data: st.DataObject) -> None:
    tick = st.tuples(*[st.sampled_from([*Action, None])] * builders)
    team = team_of(LINE, builders)
    check_team_game(TeamGrid(team), team, data.draw(st.lists(tick, max_size=40)))


@pytest.mark.parametrize("liar", [LetsThemWalkThroughEachOther, ActsInAnotherOrder, StartsElsewhere, ForgetsItsBlocks])
def test_a_team_game_with_wrong_outcomes_fails_the_contract(liar: Callable[[Team], TeamGrid]) -> None:
    with pytest.raises(AssertionError):
        check_team_game(liar(BESIDE), BESIDE, TICKS)
