"""One step of many simulated arenas at once, compiled.

The arenas are one flat array with a border of solid cells, so that one index names a cell of a run, a move is one
addition to it, and nothing has to test for the edge (grid.py).
"""

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.rules import PLACES
from mc_nested.arrays import Bools, Int64s
from mc_nested.compiled import compiled

PLACING = np.array([action in PLACES for action in Action])
FRONT = 1
"""From a cell's index to that of the cell in front of it."""


@compiled()
def step_all(
    actions: Int64s,
    runs: Bools,
    move: Int64s,
    solid: Bools,
    position: Int64s,
    front: Int64s,
    lands: Bools,
) -> bool:
    """Move, and place the block, in every arena that ``runs``, (R,); an action (R,) is an index of ``move``.

    Changes ``solid`` (R x cells,) and ``position`` (R,); writes the index in ``front``, and where a block ``lands``.
    Returns False, and changes nothing, if an arena that runs has an action that there isn't.
    """
    for run in range(len(actions)):
        if runs[run] and not 0 <= actions[run] < len(move):
            return False
    for run in range(len(actions)):
        lands[run] = False
        if runs[run]:
            ahead = position[run] + move[actions[run]]
            if not solid[ahead]:
                position[run] = ahead
        front[run] = position[run] + FRONT
        if runs[run] and PLACING[actions[run]] and not solid[front[run]]:
            solid[front[run]] = lands[run] = True
    return True
