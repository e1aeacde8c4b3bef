"""The headless simulator for several builders in one arena: their rules alone, as one TeamGame."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, resolved
from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.game import Outcome, Resumable
from mc_nested.arena.rules import cells_of, grid_of
from mc_nested.arrays import Arrays


class TeamGrid:
    """A TeamGame that follows the rules and nothing else."""

    def __init__(self, team: Team) -> None:
        self._team = team
        self._cells = team.starts
        self._placed: set[Cell] = set()

    @property
    def resumable(self) -> Resumable | None:
        """This game: its episode is nothing but cells and blocks."""
        return self

    def reset(self, material: int) -> tuple[Cell, ...]:  # noqa: ARG002 - the rules are the same for every material
        self._cells = self._team.starts
        self._placed = set()
        return self._cells

    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        scenario = self._team.scenario
        outcomes = resolved(self._cells, self._placed, actions, scenario.size, scenario.blocks - len(self._placed))
        self._cells = tuple(outcome.cell for outcome in outcomes)
        self._placed |= {outcome.placed for outcome in outcomes if outcome.placed is not None}
        return outcomes

    def snapshot(self) -> Arrays:
        """Return the cells and the blocks, for ``restore``."""
        return {
            "team_game_cells": np.array(self._cells),
            "team_game_placed": grid_of(self._placed, self._team.scenario.size),
        }

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the builders and the blocks back as they stood at ``snapshot``."""
        self._cells = tuple((x, y) for x, y in snapshot["team_game_cells"].tolist())
        self._placed = set(cells_of(snapshot["team_game_placed"]))


def team_arenas(team: Team, runs: int) -> TeamVectorEnv:
    """Return so many simulated arenas, each with all builders of that team."""
    return TeamVectorEnv([TeamGrid(team) for _ in range(runs)], team)
