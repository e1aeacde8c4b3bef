"""An episode that somebody played, and the game in which it happens again as it did."""

from dataclasses import dataclass

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Outcome, PlayLog


@dataclass(frozen=True)
class Demonstration:
    """A whole episode: the material in hand at first, and what was done, each action with its outcome.

    An action's material was taken in hand before it; None where the one in hand stayed there.
    """

    material: int
    steps: tuple[tuple[Following, Outcome], ...]


class ShownGame:
    """A game in which one demonstration is played again: it says what happened then, whatever is asked for."""

    resumable = None
    log: PlayLog | None = None

    def __init__(self, shown: Demonstration, start: Cell) -> None:
        self._shown, self._start = shown, start
        self._left = iter(shown.steps)

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - what was in hand then is known
        self._left = iter(self._shown.steps)
        return self._start

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:  # noqa: ARG002 - it is known
        _, outcome = next(self._left)
        return outcome
