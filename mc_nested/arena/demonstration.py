"""An episode that somebody played, and the game in which it happens again as it did."""

from dataclasses import dataclass
from typing import NamedTuple

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.game import Following, Outcome


class ShownStep(NamedTuple):
    """An action, the material that was in hand then, and what was confirmed of it, at which time."""

    action: Action
    material: int
    outcome: Outcome
    ended: float = 0.0


@dataclass
class Demonstration:
    """An episode from its reset on, as far as every action of it was confirmed: the material in hand at first, and all.

    ``began`` is when the reset ended; times are seconds of the player's own clock. ``is_whole``: it came to its end.
    """

    material: int
    steps: list[ShownStep]
    began: float = 0.0
    is_whole: bool = False


class ShownGame:
    """A game in which one demonstration is played again: it says what happened then, whatever is asked for."""

    resumable = log = None

    def __init__(self, shown: Demonstration, start: Cell) -> None:
        self._start, self._steps = start, shown.steps
        self._left = iter(self._steps)

    def reset(self, material: int) -> Cell:  # noqa: ARG002 - what was in hand then is known
        self._left = iter(self._steps)
        return self._start

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:  # noqa: ARG002 - it is known
        return next(self._left).outcome
