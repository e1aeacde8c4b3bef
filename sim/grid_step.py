"""One step of many simulated arenas at once, compiled.

The arenas are one flat array with a border of solid cells, so that one index names a cell of a run, a move is one
addition to it, and nothing has to test for the edge (grid.py).
"""

from typing import Any, NamedTuple

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.rules import PLACES
from mc_nested.arrays import Bools, Int64s
from mc_nested.compiled import compiled

PLACING = np.array([action in PLACES for action in Action])
FRONT = 1
"""What to add to a cell's index to get that of the cell in front of it."""


class Layout(NamedTuple):
    """The constants of a step: what each move adds to an index (actions,), each run's first index and step limit (R,).

    ``side`` is how many cells there are in a row, the border included.
    """

    move: Int64s
    base: Int64s
    step_limit: Int64s
    side: int


class Episodes(NamedTuple):
    """The episodes as they stand, (R,) each; ``solid`` is all cells of all runs."""

    solid: Bools
    position: Int64s
    blocks_left: Int64s
    steps: Int64s
    terminated: Bools
    truncated: Bools


class Stepped(NamedTuple):
    """A step's outcome, (R,) each: the index in front of the agent, whether a block landed there, what has ended."""

    front: Int64s
    lands: Bools
    ended: Bools


@compiled()
def all_exist(actions: Int64s, runs: Bools, count: int) -> bool:
    """Return whether each action (R,) of an arena that ``runs`` (R,) is one of so many."""
    exist = True
    for run in range(len(actions)):
        exist = exist and (not runs[run] or 0 <= actions[run] < count)
    return exist


@compiled()
def step_all(
    actions: Int64s, runs: Bools, arenas: tuple[Any, ...], as_they_stand: tuple[Any, ...], done: tuple[Any, ...]
) -> None:
    """Move, and place the block, in every arena that ``runs`` (R,), and write what that did into ``done``.

    An action (R,) is an index of ``Layout.move``. The others are a Layout, Episodes and Stepped as plain tuples, which
    compiled code takes over in a third of the time that named ones take.
    """
    layout, episodes, stepped = Layout(*arenas), Episodes(*as_they_stand), Stepped(*done)
    for run in range(len(actions)):
        stepped.lands[run] = stepped.ended[run] = False
        if runs[run]:
            ahead = episodes.position[run] + layout.move[actions[run]]
            if not episodes.solid[ahead]:
                episodes.position[run] = ahead
            front = episodes.position[run] + FRONT
            if PLACING[actions[run]] and not episodes.solid[front]:
                episodes.solid[front] = stepped.lands[run] = True
                episodes.blocks_left[run] -= 1
            episodes.steps[run] += 1
            episodes.terminated[run] = episodes.blocks_left[run] == 0
            episodes.truncated[run] = not episodes.terminated[run] and episodes.steps[run] >= layout.step_limit[run]
            stepped.ended[run] = episodes.terminated[run] or episodes.truncated[run]
        stepped.front[run] = episodes.position[run] + FRONT


@compiled()
def observe_all(arenas: tuple[Any, ...], as_they_stand: tuple[Any, ...], observations: Int64s) -> None:
    """Write (x, y, b) of every arena into ``observations``, (R, 3), from a Layout and Episodes as plain tuples."""
    layout, episodes = Layout(*arenas), Episodes(*as_they_stand)
    for run in range(len(observations)):
        at = episodes.position[run] - layout.base[run]
        observations[run, 0] = at // layout.side - 1
        observations[run, 1] = at % layout.side - 1
        observations[run, 2] = episodes.blocks_left[run]
