"""Game: the seam between an agent and any game, simulated or real."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arrays import Arrays


@dataclass(frozen=True)
class Outcome:
    """What an action really did: the cell where the agent is now, and the cell where a block landed, if one did.

    ``instead`` is the action that a person who has taken over did in place of the one asked for; None if nobody did.
    """

    cell: Cell
    placed: Cell | None
    instead: Action | None = None


Following = tuple[Action, int | None]
"""The action that will come next, and the index of the material to take in hand before it; None for the one there."""


class Resumable(Protocol):
    """Something whose episode can be saved half-way and continued later."""

    def snapshot(self) -> Arrays:
        """Return the current episode, for ``restore``; an array's shape never changes."""

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the episode back as it stood at ``snapshot``."""


class PlayLog(Protocol):
    """What playing a game took, in a running window: times, retries, failures."""

    def summary(self) -> dict[str, Any]:
        """Return everything as plain numbers, for a training's summary.json."""


class Game(Protocol):
    """An arena to build in. A game is made for one scenario.

    A live game raises LiveError when it can't do what was asked; it never returns an outcome that it did not see.
    """

    @property
    def resumable(self) -> Resumable | None:
        """The game, if its episode can be saved half-way; None if not: a live game's episode has to start over."""

    @property
    def log(self) -> PlayLog | None:
        """What playing took so far; None if the game doesn't measure it."""

    def reset(self, material: int) -> Cell:
        """Clear the arena, put the agent on the scenario's start cell with the material in hand; return that cell."""

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        """Do one action, the move first and then the block, and say what happened.

        Before it, take the material of that index in hand; without one, what was in hand stays there. ``following`` is
        what will be asked for next, if this action goes as the rules say: a live game may begin its walk meanwhile.
        Where it did, ValueError if something else is asked for then; a reset may come at any time.
        """
