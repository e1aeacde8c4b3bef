"""What an agent can do, and where: the eight actions, a cell, the sizes of arenas. What they lead to is in rules.py."""

from enum import IntEnum

Cell = tuple[int, int]
"""(x, y): x to the right, y forward, the way the agent looks for the whole episode (paper, section 5)."""


class Action(IntEnum):
    """The nested agent's actions in the paper's order (paper, section 5.1.2): a move, then with +D a block."""

    F = 0
    B = 1
    L = 2
    R = 3
    FD = 4
    LD = 5
    RD = 6
    BD = 7


SMALLEST_SIZE, LARGEST_SIZE = 5, 32
"""The sizes that an arena may have, both included. An arena of 32 is cleared, and copied, by one command
(FACTS: Commands), and seen whole in a terminal."""
