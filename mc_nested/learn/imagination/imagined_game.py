"""The learnt game as a Game: the same two methods as any other, made of the agent's own transitions."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome, PlayLog, Resumable
from mc_nested.arrays import Arrays
from mc_nested.learn.imagination.arena_step import NOWHERE, ImaginedArena, cell_at, index_of, step


class ImaginedGame:
    """A Game that does what the agent has learnt its game does.

    Args:
        arena: the learnt rules, as arrays.
        start: where an episode begins, as every reset has shown.
    """

    def __init__(self, arena: ImaginedArena, start: Cell) -> None:
        self._arena = arena
        self._start = index_of(start, arena)
        self._position = self._start
        self._solid = arena.empty.copy()

    @property
    def resumable(self) -> Resumable | None:
        """This game: its episode is nothing but a cell and the blocks."""
        return self

    @property
    def log(self) -> PlayLog | None:
        """None: imagined actions take no time."""
        return None

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - what was learnt is the same for every material
        self._position = self._start
        self._solid = self._arena.empty.copy()
        return cell_at(self._position, self._arena)

    def act(self, action: Action, material: int | None = None) -> Outcome:  # noqa: ARG002 - and so are these
        self._position, block = step(self._arena, self._position, int(action), self._solid)
        placed = None if block == NOWHERE else cell_at(block, self._arena)
        return Outcome(cell_at(self._position, self._arena), placed)

    def snapshot(self) -> Arrays:
        """The agent's place and what is solid, for ``restore``."""
        return {"imagined_position": np.array(self._position), "imagined_solid": self._solid.copy()}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the agent and the blocks back as they stood at ``snapshot``."""
        self._position = int(snapshot["imagined_position"])
        self._solid = snapshot["imagined_solid"].copy()
