"""What a run has seen of its arena, for those who watch: what it believes, and what it spent its episodes on."""

from dataclasses import dataclass
from typing import NamedTuple

from mc_nested.arena.action import Cell
from mc_nested.arrays import Int8s, Int64s
from mc_nested.learn.imagination.beliefs import Belief, Beliefs
from mc_nested.learn.imagination.experience import Experience


class Spent(NamedTuple):
    """What the blocks of one real episode were spent on; ``episode`` counts from 1.

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
    ``spent`` the episodes that it remembers, oldest first; ``explores``: too few paying cells are known.
    """

    cells: Int8s
    built_last: frozenset[Cell]
    spent: tuple[Spent, ...]
    explores: bool

    @property
    def known_to_pay(self) -> int:
        """Cells that are known to pay."""
        return int((self.cells == Belief.PAYS).sum())


def known_arena(experience: Experience, lands: Cell, beliefs: Beliefs) -> KnownArena:
    """Return what that experience shows if blocks land at ``lands`` from the agent, and the beliefs that follow."""
    episodes = _by_episode(experience.steps, experience.first_of_episode)
    own = min(experience.episodes, len(episodes))
    earlier, remembered = episodes[: len(episodes) - own], episodes[len(episodes) - own :]
    tried: dict[Cell, bool] = {}
    for steps in earlier:
        _spend(0, steps, lands, tried)
    first = experience.episodes - own + 1
    spent = tuple(_spend(first + at, steps, lands, tried) for at, steps in enumerate(remembered))
    last = frozenset(cell for cell, _ in _landings(remembered[-1], lands)) if remembered else frozenset[Cell]()
    return KnownArena(beliefs.cells, last, spent, beliefs.explores)


def _by_episode(steps: Int64s, first_of_episode: Int64s) -> list[Int64s]:
    ends = [*first_of_episode[1:].tolist(), len(steps)]
    return [steps[first:end] for first, end in zip(first_of_episode.tolist(), ends, strict=False)]


def _landings(steps: Int64s, lands: Cell) -> list[tuple[Cell, int]]:
    """Return where each block of those steps landed, and whether it was paid (experience.py: paid)."""
    used = steps[steps[:, 2] > steps[:, 6]]
    return [((x + lands[0], y + lands[1]), paid) for x, y, paid in used[:, [4, 5, 7]].tolist()]


def _spend(episode: int, steps: Int64s, lands: Cell, tried: dict[Cell, bool]) -> Spent:
    """Return what those steps were spent on; ``tried`` (whether each cell paid when last tried) gets what they try."""
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
    return Spent(episode, new, new_paid, built, other)
