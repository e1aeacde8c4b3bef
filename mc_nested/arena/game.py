"""Game: the seam between an agent and any game, simulated or real. Nothing else crosses it."""

from dataclasses import dataclass
from typing import Protocol

from mc_nested.arena.rules import Action, Cell


@dataclass(frozen=True)
class Outcome:
    """What an action really did: the cell where the agent stands now, and the cell where a block landed, if one did."""

    cell: Cell
    placed: Cell | None


class Game(Protocol):
    """An arena to build in. A game knows its scenario from the day it is made.

    A live game raises LiveError when it can't do what was asked; it never returns an outcome that it did not see.
    """

    def reset(self, material: int) -> Cell:
        """Clear the arena, put the agent on the scenario's start cell with the material in hand; return that cell."""

    def act(self, action: Action) -> Outcome:
        """Do one action, the move first and then the block, and say what happened."""
