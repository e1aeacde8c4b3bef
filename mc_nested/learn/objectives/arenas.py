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
from mc_nested.learn.dqn.states import AGENT, LOSES, OCCUPIED, ORDER_PLANES, REACH_PLANES, WANTED, Sees

NOWHERE = -1
"""Both coordinates of the cell where no block landed, and of no objective."""

MOVES = np.array([STEP[action] for action in Action], np.int64)

ROUND = np.array(((0, 1), (1, 0), (0, -1), (-1, 0)), np.int64)
"""The steps to a cell's four neighbours, each a quarter turn from the one before."""

PLACE = np.array([action in PLACES for action in Action], np.bool_)


def side_for(size: int) -> int:
    """Return the cells a side of the smallest frame around an arena of that size."""
    return size + 2


def framed(cell: Cell) -> Cell:
    """Return where an arena's cell lies in its frame."""
    return cell[0] + 1, cell[1] + 1


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


def order_planes(wanted: Bools, occupied: Bools, agents: Int64s) -> tuple[Bools, Int64s]:
    """Return what the main agent sees of R arenas, (R, ORDER_PLANES, side, side), and how many cells are lost, (R,).

    Of those, it sees none.

    Args:
        wanted: the cells still to build, (R, side, side).
        occupied: (R, side, side).
        agents: where the agents are, (R, 2).
    """
    planes = reach_planes(wanted, occupied, agents, count=ORDER_PLANES)
    planes[:, LOSES], lost = look_ahead(planes[:, WANTED], planes[:, OCCUPIED], agents)
    return planes, lost


def reach_planes(
    wanted: Bools, occupied: Bools, agents: Int64s, sees: Sees = "everything", count: int = REACH_PLANES
) -> Bools:
    """Return what the nested agent sees of R arenas, (R, count, side, side); planes beyond REACH_PLANES are empty.

    Args:
        wanted: the objective, (R, side, side).
        occupied: (R, side, side).
        agents: where the agents are, (R, 2).
        sees: without the objective, every cell is marked as if it were; without what stands, the frame's edge alone is.
        count: how many planes.
    """
    planes = np.zeros((len(agents), count, *occupied.shape[1:]), np.bool_)
    planes[:, WANTED], planes[:, OCCUPIED] = wanted | (sees == "surroundings"), occupied
    if sees == "objective":
        planes[:, OCCUPIED, 1:-1, 1:-1] = False
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
def reached_from(occupied: Bools, x: int, y: int, waiting: Int64s) -> Bools:
    """Return which cells of an arena (side, side) one gets to from a cell; ``waiting`` (side * side, 2) is room."""
    reached = np.zeros(occupied.shape, np.bool_)
    reached[x, y] = True
    waiting[0, 0], waiting[0, 1] = x, y
    ends, begins = 1, 0
    while begins < ends:
        for move in range(len(ROUND)):
            to_x, to_y = waiting[begins, 0] + ROUND[move, 0], waiting[begins, 1] + ROUND[move, 1]
            if not (occupied[to_x, to_y] or reached[to_x, to_y]):
                reached[to_x, to_y] = True
                waiting[ends, 0], waiting[ends, 1] = to_x, to_y
                ends += 1
        begins += 1
    return reached


@compiled()
def look_ahead(to_build: Bools, occupied: Bools, agents: Int64s) -> tuple[Bools, Int64s]:
    """Return which cells to build would lose another one now, (R, side, side), and how many are lost, (R,).

    A block cuts off what the agent can't build any more from the cell before it. Blocks are never taken away: so what
    is cut off, or can't be reached, stays so, and of cells that cut off one another in a circle one is lost, too. The
    lost ones are taken out of those to build. A block loses what it cuts off, and where it leads to such a circle.
    """
    runs, side, _ = occupied.shape
    loses, lost = np.zeros(to_build.shape, np.bool_), np.zeros(runs, np.int64)
    waiting = np.empty((side * side, 2), np.int64)
    for row in range(runs):
        stands = occupied[row].copy()
        cells = take_out_lost(to_build[row], stands, agents[row], waiting, lost[row : row + 1])
        cuts = cuts_off(cells, stands, waiting)
        for own in range(len(cells)):
            x, y = cells[own]
            if cuts[own].any():
                loses[row, x, y] = True
                continue
            stands[x, y] = True
            others = np.concatenate((cells[:own], cells[own + 1 :]))
            loses[row, x, y] = len(in_circles(cuts_off(others, stands, waiting))) > 0
            stands[x, y] = False
    return loses, lost


@compiled()
def take_out_lost(to_build: Bools, stands: Bools, agent: Int64s, waiting: Int64s, lost: Int64s) -> Int64s:
    """Take the lost cells out of those to build, and return the others, (n, 2); ``lost`` (1,) counts them."""
    side = len(stands)
    cells, count = np.empty((side * side, 2), np.int64), 0
    reached = reached_from(stands, agent[0], agent[1], waiting)
    for x in range(side):
        for y in range(1, side):
            if to_build[x, y] and not stands[x, y] and reached[x, y - 1]:
                cells[count, 0], cells[count, 1] = x, y
                count += 1
            elif to_build[x, y]:
                to_build[x, y] = False
                lost[0] += 1
    is_left = np.ones(count, np.bool_)
    for own in in_circles(cuts_off(cells[:count], stands, waiting)):
        is_left[own] = to_build[cells[own, 0], cells[own, 1]] = False
        lost[0] += 1
    return cells[:count][is_left]


@compiled()
def cuts_off(cells: Int64s, stands: Bools, waiting: Int64s) -> Bools:
    """Return whether a block on each cell (n, 2), of cells that can be built now, cuts off each other one, (n, n)."""
    count = len(cells)
    cuts = np.zeros((count, count), np.bool_)
    for own in range(count):
        x, y = cells[own]
        if is_narrow(stands, x, y):
            stands[x, y] = True
            reached = reached_from(stands, x, y - 1, waiting)
            stands[x, y] = False
            for other in range(count):
                cuts[own, other] = other != own and not reached[cells[other, 0], cells[other, 1] - 1]
        else:  # then it cuts off the cell that is built from there, and nothing else
            for other in range(count):
                cuts[own, other] = cells[other, 0] == x and cells[other, 1] == y + 1
    return cuts


@compiled()
def is_narrow(stands: Bools, x: int, y: int) -> bool:
    """Return whether a block there parts the free cells beside it, as far as the eight around it show."""
    parts = 0
    for turn in range(len(ROUND)):
        step, corner, following = ROUND[turn], ROUND[turn] + ROUND[turn - 1], ROUND[turn - 1]
        if not stands[x + step[0], y + step[1]] and (
            stands[x + corner[0], y + corner[1]] or stands[x + following[0], y + following[1]]
        ):
            parts += 1
    return parts > 1


@compiled()
def in_circles(cuts: Bools) -> Int64s:
    """Return which cells to leave out, so that there is an order of the others in which none cuts off a later one.

    ``cuts`` (cells, cells): whether a cell's block cuts off another cell.
    """
    count = len(cuts)
    left, out, outs = np.ones(count, np.bool_), np.empty(count, np.int64), 0
    cut = np.zeros(count, np.int64)
    for own in range(count):
        cut[own] = cuts[own].sum()
    while left.any():
        own = -1
        for each in range(count):  # its turn can be now; or, of those in circles, the one that cuts off most
            if left[each] and (own < 0 or (cut[own] and (not cut[each] or cut[each] > cut[own]))):
                own = each
        if cut[own]:
            out[outs] = own
            outs += 1
        left[own] = False
        for other in range(count):
            cut[other] -= cuts[other, own]
    return out[:outs]
