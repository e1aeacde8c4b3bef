"""Arenas side by side, as the agents with objectives see them: what stands, what is wanted, and where the agent is.

Each arena lies in a frame of ``side`` cells a side, from its cell (1, 1) on. All beside it is occupied: so nothing has
to test for the edge, and arenas of any size that fits are planes of one shape.
"""

from collections.abc import Collection

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import PLACES, STEP
from mc_nested.arrays import Bools, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.states import AGENT, OBJECTIVE_PLANES, OCCUPIED, WANTED

NOWHERE = -1
"""Both coordinates of the cell where no block landed, and of no objective."""

MOVES = np.array([STEP[action] for action in Action], np.int64)
STEPS = np.unique(MOVES, axis=0)
"""The four steps to a cell's neighbours."""

PLACE = np.array([action in PLACES for action in Action], np.bool_)


def side_for(size: int) -> int:
    """Return the cells a side of the smallest frame around an arena of that size."""
    return size + 2


def framed(cell: Cell) -> Cell:
    """Return where an arena's cell lies in its frame."""
    return cell[0] + 1, cell[1] + 1


def out_of_frame(cell: Cell) -> Cell:
    """Return which of the arena's cells lies there in its frame."""
    return cell[0] - 1, cell[1] - 1


def framed_cells(cells: Collection[Cell], side: int) -> Bools:
    """Return a plane that marks an arena's cells, (side, side)."""
    plane = np.zeros((side, side), np.bool_)
    for x, y in cells:
        plane[x + 1, y + 1] = True
    return plane


def outside(size: int, side: int) -> Bools:
    """Return the plane of an empty arena: all beside it is occupied, (side, side)."""
    plane = np.ones((side, side), np.bool_)
    plane[1 : size + 1, 1 : size + 1] = False
    return plane


def planes_of(wanted: Bools, occupied: Bools, agents: Int64s) -> Bools:
    """Return what an agent sees of R arenas, (R, OBJECTIVE_PLANES, side, side).

    Args:
        wanted: the objective, or the cells still to build, (R, side, side).
        occupied: (R, side, side).
        agents: where the agents are, (R, 2).
    """
    planes = np.zeros((len(agents), OBJECTIVE_PLANES, *occupied.shape[1:]), np.bool_)
    planes[:, WANTED], planes[:, OCCUPIED] = wanted, occupied
    planes[np.arange(len(agents)), AGENT, agents[:, 0], agents[:, 1]] = True
    return planes


def plane_of_each(cells: Int64s, side: int) -> Bools:
    """Return a plane for each cell (R, 2), which marks it alone, (R, side, side)."""
    planes = np.zeros((len(cells), side, side), np.bool_)
    planes[np.arange(len(cells)), cells[:, 0], cells[:, 1]] = True
    return planes


@compiled()
def step(occupied: Bools, agents: Int64s, actions: Int64s, rows: Int64s, landed: Int64s) -> None:
    """Do an action (k,) in each of the named arenas (k,), in place; ``landed`` (k, 2) is where its block landed.

    It is NOWHERE where none did. Two arenas are never the same.
    """
    for at in range(len(rows)):
        row, action = rows[at], actions[at]
        x, y = agents[row, 0] + MOVES[action, 0], agents[row, 1] + MOVES[action, 1]
        if not occupied[row, x, y]:
            agents[row, 0], agents[row, 1] = x, y
        x, y = agents[row, 0], agents[row, 1] + 1
        landed[at] = NOWHERE
        if PLACE[action] and not occupied[row, x, y]:
            occupied[row, x, y] = True
            landed[at, 0], landed[at, 1] = x, y


@compiled()
def take_out_lost(to_build: Bools, occupied: Bools, agents: Int64s) -> Int64s:
    """Take the cells that can't be built any more out of those to build, and return how many they were, (R,).

    Blocks are never taken away. So what the agent can't reach now, it never will.
    """
    runs, side, _ = occupied.shape
    lost = np.zeros(runs, np.int64)
    waiting = np.empty((side * side, 2), np.int64)
    for row in range(runs):
        reached = np.zeros((side, side), np.bool_)
        reached[agents[row, 0], agents[row, 1]] = True
        waiting[0] = agents[row]
        ends, begins = 1, 0
        while begins < ends:
            for move in range(len(STEPS)):
                x, y = waiting[begins, 0] + STEPS[move, 0], waiting[begins, 1] + STEPS[move, 1]
                if not (occupied[row, x, y] or reached[x, y]):
                    reached[x, y] = True
                    waiting[ends, 0], waiting[ends, 1] = x, y
                    ends += 1
            begins += 1
        for x in range(side):
            for y in range(1, side):
                if to_build[row, x, y] and (occupied[row, x, y] or not reached[x, y - 1]):
                    to_build[row, x, y] = False
                    lost[row] += 1
    return lost
