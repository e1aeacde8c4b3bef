"""What a run knows of its arena, for those who watch: what it believes, and where the blocks of its episodes went."""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arrays import Int8s, Int64s
from mc_nested.learn.imagination.beliefs import Belief, Beliefs
from mc_nested.learn.imagination.experience import Experience


class EpisodeBlocks(NamedTuple):
    """Counts of where the blocks of one real episode landed; ``episode`` counts from 1.

    ``new`` landed in cells that were never tried before, ``new_paid`` of them on the design; ``built`` landed where it
    was known to pay, and did; ``other`` is the rest.
    """

    episode: int
    new: int
    new_paid: int
    built: int
    other: int

    @property
    def probes(self) -> bool:
        """Whether it tried a cell: otherwise it only built."""
        return self.new > 0


@dataclass(frozen=True)
class KnownArena:
    """What one run knows of its arena.

    ``cells`` (size, size) holds a Belief for each; ``built_last`` are the cells built in its last real episode,
    ``episodes`` those that it remembers, oldest first; ``explores``: too few paying cells are known.
    """

    cells: Int8s
    built_last: frozenset[Cell]
    episodes: tuple[EpisodeBlocks, ...]
    explores: bool

    @property
    def known_to_pay(self) -> int:
        """Cells that are known to pay."""
        return int((self.cells == Belief.PAYS).sum())


class Knowing(Protocol):
    """Runs that find out what their arenas are like."""

    def episodes(self, run: int) -> int:
        """Return how many real episodes that run has begun."""

    def known_arena(self, run: int) -> KnownArena:
        """Return what that run knows of its arena now, and where the blocks of its real episodes went."""


def known_arena(experience: Experience, lands: Cell, beliefs: Beliefs) -> KnownArena:
    """Return what that experience shows if blocks land at ``lands`` from the agent, and the beliefs that follow."""
    all_episodes = np.split(experience.steps, experience.first_of_episode[1:])
    own = min(experience.episodes, len(all_episodes))
    earlier, remembered = all_episodes[: len(all_episodes) - own], all_episodes[len(all_episodes) - own :]
    tried: dict[Cell, bool] = {}
    for steps in earlier:
        _blocks_of(0, steps, lands, tried)
    first = experience.episodes - own + 1
    episodes = tuple(_blocks_of(first + at, steps, lands, tried) for at, steps in enumerate(remembered))
    last = frozenset(cell for cell, _ in _landings(remembered[-1], lands)) if remembered else frozenset[Cell]()
    return KnownArena(beliefs.cells, last, episodes, beliefs.explores)


def _landings(steps: Int64s, lands: Cell) -> list[tuple[Cell, int]]:
    """Return where each block of those steps landed, and whether it was paid (experience.py: paid)."""
    used = steps[steps[:, 2] > steps[:, 6]]
    return [((x + lands[0], y + lands[1]), paid) for x, y, paid in used[:, [4, 5, 7]].tolist()]


def _blocks_of(episode: int, steps: Int64s, lands: Cell, tried: dict[Cell, bool]) -> EpisodeBlocks:
    """Return where those steps' blocks landed; ``tried`` (whether each cell paid when last tried) gets theirs."""
    new = new_paid = built = other = 0
    for cell, paid in _landings(steps, lands):
        if paid < 0:
            continue
        if cell not in tried:
            new += 1
            new_paid += paid
        elif tried[cell] and paid:
            built += 1
        else:
            other += 1
        tried[cell] = bool(paid)
    return EpisodeBlocks(episode, new, new_paid, built, other)
