"""The learnt game, played: where an action leads and where its block lands, compiled; and what an episode should do.

The arena is flat, with a border of solid cells as wide as any learnt move is long, so that nothing has to test for the
edge, and one index names a cell.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools, Float32s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.imagination.beliefs import Beliefs
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.learnt_rules import LearntRules

NOWHERE = 0
"""Stands for no cell where no block landed: a corner of the border."""


class ImaginedArena(NamedTuple):
    """The learnt game as flat arrays of cells, the border included.

    ``moves`` (actions,) and ``lands`` are differences of indices, ``places`` (actions,) says which actions place a
    block. ``empty`` is the arena before the first block, True where nobody can go; ``pay`` what is imagined to be paid.
    """

    moves: Int64s
    places: Bools
    lands: int
    empty: Bools
    pay: Float32s
    side: int
    border: int


def imagined_arena(rules: LearntRules, beliefs: Beliefs) -> ImaginedArena:
    """Return the learnt game of these rules and beliefs."""
    size = len(beliefs.pay)
    border = int(max(np.abs(rules.moves).max(initial=1), *np.abs(rules.lands)))
    side = size + 2 * border
    strides = np.array([side, 1])
    return ImaginedArena(
        moves=rules.moves @ strides,
        places=rules.places,
        lands=int(np.array(rules.lands) @ strides),
        empty=np.pad(rules.walls, border, constant_values=True).ravel(),
        pay=np.pad(beliefs.pay, border).ravel(),
        side=side,
        border=border,
    )


def index_of(cell: Cell, arena: ImaginedArena) -> int:
    """Return the index of a cell."""
    return (cell[0] + arena.border) * arena.side + cell[1] + arena.border


def cell_at(index: int, arena: ImaginedArena) -> Cell:
    """Return the cell of an index."""
    x, y = divmod(index, arena.side)
    return x - arena.border, y - arena.border


@compiled(nogil=True)
def step(arena: ImaginedArena, position: int, action: int, solid: Bools) -> tuple[int, int]:
    """Do the action: where the agent is then, and where a block landed, or NOWHERE; ``solid`` gets that block."""
    ahead = position + arena.moves[action]
    if not solid[ahead]:
        position = ahead
    block = position + arena.lands
    if not arena.places[action] or solid[block]:
        return position, NOWHERE
    solid[block] = True
    return position, block


State = tuple[int, int, int]
"""x, y and the blocks left."""


def expected_landings(
    arena: ImaginedArena, start: State, step_limit: int, policy: Callable[[State], int], tries: FirstTries
) -> list[Cell]:
    """Return where an episode's blocks should land, in order. ``tries`` come before the policy, and count what it does.

    Args:
        arena: the learnt game.
        start: the state after a reset.
        step_limit: steps of an episode at most.
        policy: the action in a state.
        tries: of a plan's own, since it is changed.
    """
    seen = Experience()
    seen.begin()
    solid = arena.empty.copy()
    (x, y, blocks), position = start, index_of(start[:2], arena)
    landings: list[Cell] = []
    for _ in range(step_limit):
        if blocks == 0:
            break
        action = tries.act(policy((x, y, blocks)), seen.tried_here())
        position, landed = step(arena, position, action, solid)
        next_x, next_y = cell_at(position, arena)
        tries.observe(action, (next_x, next_y) != (x, y), seen.tried_here())
        left = blocks - (landed != NOWHERE)
        seen.add(RealStep(x, y, blocks, action, next_x, next_y, left, 0, 0))
        if landed != NOWHERE:
            landings.append(cell_at(landed, arena))
        x, y, blocks = next_x, next_y, left
    return landings


GREEDY_EVERY = 10
"""Every so many imagined episodes one is greedy, and nothing is learnt from it: whether its aim is reached."""


class ImaginedTask(NamedTuple):
    """What is practised: from where, with how many blocks, for how many steps at most, and which score is enough.

    ``strides`` (3,) are what x, y and b count for in a state's index, ``offset`` what the rest of it does.
    """

    start: int
    blocks: int
    step_limit: int
    aim: float
    strides: Int64s
    offset: int


@compiled(nogil=True)
def state_at(position: int, blocks: int, arena: ImaginedArena, task: ImaginedTask) -> int:
    """Return the index of the state in that cell with so many blocks."""
    x, y = position // arena.side - arena.border, position % arena.side - arena.border
    state: int = x * task.strides[0] + y * task.strides[1] + blocks * task.strides[2] + task.offset
    return state


@compiled(nogil=True)
def is_wasted(landed: int, arena: ImaginedArena) -> bool:
    """Return whether a block landed where no pay is imagined: an imagined episode that learns ends there."""
    wasted: bool = landed != NOWHERE and arena.pay[landed] == 0
    return wasted


@compiled(nogil=True)
def epsilon_from(uniform: float, highest: float, lowest: float) -> float:
    """Return an ε of an imagined episode, equally likely on a logarithmic scale, from a number in [0, 1)."""
    epsilon: float = np.exp(np.log(lowest) + uniform * (np.log(highest) - np.log(lowest)))
    return epsilon
