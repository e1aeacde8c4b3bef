"""A small arena as a run may know it."""

import numpy as np

from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.known_arena import EpisodeBlocks, KnownArena


def made_known_arena(size: int = 4, episodes: int = 3) -> KnownArena:
    """Return two cells that pay, one of them built; one that doesn't, and was built on; one believed to pay."""
    cells = np.full((size, size), Belief.UNKNOWN, dtype=np.int8)
    cells[0, 0] = cells[1, 0] = Belief.PAYS
    cells[2, 0] = Belief.BELIEVED
    cells[3, 3] = Belief.PAYS_NOT
    played = tuple(EpisodeBlocks(number, 2, 1, number, 1) for number in range(1, episodes + 1))
    return KnownArena(cells, frozenset({(0, 0), (3, 3)}), played, explores=True)
