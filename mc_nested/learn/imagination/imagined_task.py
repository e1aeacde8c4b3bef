"""What is practised in the learnt game; what the table and the networks that practise it have in common, compiled."""

from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.imagination.arena_step import NOWHERE, ImaginedArena

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
    """The index of the state in that cell with so many blocks."""
    x, y = position // arena.side - arena.border, position % arena.side - arena.border
    state: int = x * task.strides[0] + y * task.strides[1] + blocks * task.strides[2] + task.offset
    return state


@compiled(nogil=True)
def is_wasted(landed: int, arena: ImaginedArena) -> bool:
    """Whether a block landed where nothing is imagined to be paid: an imagined episode that learns ends there."""
    wasted: bool = landed != NOWHERE and arena.pay[landed] == 0
    return wasted


@compiled(nogil=True)
def epsilon_from(uniform: float, highest: float, lowest: float) -> float:
    """An ε of an imagined episode, equally likely on a logarithmic scale, from a number in [0, 1)."""
    epsilon: float = np.exp(np.log(lowest) + uniform * (np.log(highest) - np.log(lowest)))
    return epsilon
