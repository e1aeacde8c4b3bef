"""TeamEnv: the episodes of a team, over any TeamGame: what each builder sees and earns, and when it is over.

Its arena is drawn from above, the far edge on top, each builder in a colour of its own.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.cooperative.team import Team, TeamGame
from mc_nested.arena.drawing import AGENT_BODY, CELL_PX, Colour, Picture, draw_agent, draw_picture, kind_of
from mc_nested.arena.game import Resumable
from mc_nested.arena.rules import cells_of, grid_of
from mc_nested.arena.vector import NO_ACTION
from mc_nested.arrays import Arrays, Float64s, Int64s


@dataclass(frozen=True)
class TeamStep:
    """What a tick led to.

    ``observations`` (k, …) are what each builder sees, ``rewards`` (k,) what each earned. ``score`` is the team's
    r_M on the last tick, and 0 before.
    """

    observations: Int64s
    rewards: Float64s
    terminated: bool
    truncated: bool
    score: float


class TeamEnv:
    """One arena with k builders.

    A builder observes (x, y, b), (k, 3) together: its own cell, and the blocks that the team has left. It earns r_N for
    its own block alone: 1 if that is on the design. The score is the main agent's r_M, of all blocks. The episode is
    terminated when no block is left, and truncated at the scenario's step limit, which counts ticks.
    """

    def __init__(self, game: TeamGame, team: Team) -> None:
        self.game = game
        self.team = team
        self._cells = team.starts
        self._placed: frozenset[Cell] = frozenset()
        self._material = team.scenario.best_material
        self._ticks = 0
        self._running = False

    @property
    def cells(self) -> tuple[Cell, ...]:
        """Where each builder stands."""
        return self._cells

    @property
    def placed(self) -> frozenset[Cell]:
        """The cells where a block landed since the last reset."""
        return self._placed

    def reset(self, material: int) -> Int64s:
        """Begin an episode of that material for the whole team; what each builder sees."""
        self._running = False
        self._cells = self.game.reset(material)
        self._placed = frozenset()
        self._material, self._ticks = material, 0
        self._running = True
        return self._observations()

    def step(self, actions: Sequence[int] | Int64s) -> TeamStep:
        """One tick, an action or NO_ACTION of each builder; ResetNeeded if no episode runs."""
        if not self._running:
            raise ResetNeeded("the episode has ended, or none has begun: call reset() first")
        self._running = False
        scenario = self.team.scenario
        outcomes = self.game.act([None if action == NO_ACTION else Action(int(action)) for action in actions])
        self._cells = tuple(outcome.cell for outcome in outcomes)
        self._placed |= {outcome.placed for outcome in outcomes if outcome.placed is not None}
        self._ticks += 1
        terminated = len(self._placed) == scenario.blocks
        truncated = not terminated and self._ticks >= scenario.step_limit
        self._running = not (terminated or truncated)
        rewards = np.array([1.0 if outcome.placed in scenario.design else 0.0 for outcome in outcomes])
        score = 0.0 if self._running else scenario.score(self._placed, self._material)
        return TeamStep(self._observations(), rewards, terminated, truncated, score)

    @property
    def resumable(self) -> Resumable | None:
        """This arena, if its game can be resumed."""
        return self if self.game.resumable else None

    def snapshot(self) -> Arrays:
        """The current episode, the game's part included, for ``restore``. The game must be resumable."""
        game = self.game.resumable.snapshot() if self.game.resumable else {}
        return {
            **game,
            "team_stands_at": np.array([self._material, self._ticks, self._running]),
            "team_cells": np.array(self._cells),
            "team_placed": grid_of(self._placed, self.team.scenario.size),
        }

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the episode back as it stood at ``snapshot``."""
        self._material, self._ticks, running = (int(value) for value in snapshot["team_stands_at"])
        self._running = bool(running)
        self._cells = tuple((x, y) for x, y in snapshot["team_cells"].tolist())
        self._placed = cells_of(snapshot["team_placed"])
        if self.game.resumable:
            self.game.resumable.restore(snapshot)

    def _observations(self) -> Int64s:
        left = self.team.scenario.blocks - len(self._placed)
        return np.array([(*cell, left) for cell in self._cells], dtype=np.int64)


BODIES: tuple[Colour, ...] = (AGENT_BODY, (34, 122, 74), (122, 66, 160), (24, 118, 150))
"""The builders' colours, by number: red, green, violet, blue."""


def draw_team_text(team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> str:
    """The arena as a line of text a row, two characters a cell; a builder is its number."""
    across = range(team.scenario.size)
    number_at = {cell: str(number) for number, cell in enumerate(cells)}
    rows = (
        " ".join(number_at.get((x, y)) or kind_of(team.scenario, None, placed, (x, y)) for x in across)
        for y in reversed(across)
    )
    return "\n".join(rows)


def draw_team_picture(team: Team, cells: Sequence[Cell], placed: Collection[Cell], cell_px: int = CELL_PX) -> Picture:
    """The arena as ``draw_picture`` draws it, (size * cell_px, size * cell_px, 3), with every builder."""
    picture = draw_picture(team.scenario, None, placed, cell_px)
    for cell, body in zip(cells, BODIES, strict=False):
        draw_agent(picture, team.scenario.size, cell, cell_px, body)
    return picture


def rendered_team(mode: str | None, team: Team, cells: Sequence[Cell], placed: Collection[Cell]) -> Any:
    """The arena from above as a render mode wants it; None without one."""
    if mode == "rgb_array":
        return draw_team_picture(team, cells, placed)
    if mode == "ansi":
        return draw_team_text(team, cells, placed)
    return None
