"""TeamGame: what Game is for one builder, for several in one arena, simulated or real."""

from collections.abc import Sequence
from typing import Protocol

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Outcome, Resumable


class TeamGame(Protocol):
    """An arena that k builders build in. A game is made for one Team.

    A live game raises LiveError when a builder can't do what was asked; the arena has to be reset then.
    """

    @property
    def resumable(self) -> Resumable | None:
        """The game, if its episode can be saved half-way; None if not."""

    def reset(self, material: int) -> tuple[Cell, ...]:
        """Clear the arena, put each builder on its start cell with the material in hand; return those cells."""

    def act(self, actions: Sequence[Action | None]) -> tuple[Outcome, ...]:
        """Do one tick, an action or None for each builder (team_rules.py), and say what happened, by number."""
