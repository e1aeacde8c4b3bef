"""What the agent's own transitions say about moving and placing: each rule is what most of them agree on.

Taken as known: the arena is a grid of the cells that observations can name, what was placed stays, and nobody enters
the cell of a block. Learnt: where each action leads, which actions place a block, and where it lands.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools, Int64s

REACH = 1
"""How far from the agent a block can land, in cells along each axis."""

PLACES_ABOVE = 0.5
"""An action places a block if it used one in more than this share of its tries where a block could land."""


CLEAR = 2
"""How many votes an action's commonest step must be ahead by, where actions slip."""


@dataclass(frozen=True)
class LearntRules:
    """The rules as learnt so far.

    ``moves`` (actions, 2) is the cells that each action's move covers, ``known`` (actions,) whether it was ever seen to
    move, ``places`` (actions,) whether it places a block after it, ``lands`` where: cells from the agent.
    """

    moves: Int64s
    known: Bools
    places: Bools
    lands: Cell


def learn_rules(steps: Int64s, first_of_episode: Int64s, actions: int, size: int) -> LearntRules:
    """Return the rules that most transitions (steps, 9) (experience.py) of a ``size`` x ``size`` arena agree on."""
    moves, known = _learn_moves(steps, actions)
    around = [
        (right, forward)
        for right in range(-REACH, REACH + 1)
        for forward in range(-REACH, REACH + 1)
        if (right, forward) != (0, 0)
    ]
    explained = [_replay(steps, first_of_episode, moves, size, lands) for lands in around]
    counted = [_count_uses(steps, each.fits, actions) for each in explained]
    # Where a block can land, an action places one always or never: its odd tries speak against that place.
    odd = [int(np.minimum(uses, tries - uses).sum()) for tries, uses in counted]
    best = max(range(len(around)), key=lambda at: explained[at].score - odd[at])
    tries, uses = counted[best]
    # An action that was never tried where a block could land is taken to place one: trying it will tell.
    places: Bools = uses > PLACES_ABOVE * tries - (tries == 0)
    return LearntRules(moves, known, places, around[best])


def unclear_moves(steps: Int64s, actions: int) -> Bools:
    """Return which actions' moves may be slips (actions,): none where no action has ever made two different steps."""
    votes = [np.sort(votes)[::-1] for _, votes in _steps_made(steps, actions)]
    if all(len(each) < 2 for each in votes):
        return np.zeros(actions, dtype=np.bool_)
    return np.array([int(each[:1].sum() - each[1:2].sum()) < CLEAR for each in votes])


def _learn_moves(steps: Int64s, actions: int) -> tuple[Int64s, Bools]:
    """Return the commonest step that each action ever made (actions, 2), and whether it made any (actions,)."""
    moves = np.zeros((actions, 2), dtype=np.int64)
    known = np.zeros(actions, dtype=np.bool_)
    for action, (found, votes) in enumerate(_steps_made(steps, actions)):
        if len(found):
            moves[action], known[action] = found[votes.argmax()], True
    return moves, known


def _steps_made(steps: Int64s, actions: int) -> list[tuple[Int64s, Int64s]]:
    """Return, for each action, the different steps that it made (k, 2), and how often it made each (k,)."""
    shifts = steps[:, 4:6] - steps[:, 0:2]
    went = shifts.any(axis=1)
    of_actions = (shifts[went & (steps[:, 3] == action)] for action in range(actions))
    return [np.unique(each, axis=0, return_counts=True) for each in of_actions]


def _count_uses(steps: Int64s, fits: Bools, actions: int) -> tuple[Int64s, Int64s]:
    """Return how often each action was tried in those steps, and how often it used a block, (actions,) each."""
    used = steps[:, 2] > steps[:, 6]
    return np.bincount(steps[fits, 3], minlength=actions), np.bincount(steps[fits & used, 3], minlength=actions)


class _Replayed(NamedTuple):
    """How well a place for blocks explains what happened, and in which steps (steps,) a block could have landed."""

    score: int
    fits: Bools


def _replay(steps: Int64s, first_of_episode: Int64s, moves: Int64s, size: int, lands: Cell) -> _Replayed:
    """Replay the transitions with blocks that land at ``lands`` from the agent.

    A step speaks for it where a walker was stopped by a block that landed there, or a block was used and that cell was
    free; against it where a walker went through such a block, was stopped by nothing, or that cell was taken.
    """
    score = 0
    begins = set(first_of_episode.tolist())
    taken: set[Cell] = set()
    fits = np.zeros(len(steps), dtype=np.bool_)
    for at, (x, y, blocks, action, next_x, next_y, next_blocks, *_) in enumerate(steps.tolist()):
        if at in begins:
            taken = set()
        ahead = (x + int(moves[action, 0]), y + int(moves[action, 1]))
        if (next_x, next_y) in taken:
            score -= 1
        elif (next_x, next_y) == (x, y) != ahead and _is_inside(ahead, size):
            score += 1 if ahead in taken else -1
        block = (next_x + lands[0], next_y + lands[1])
        fits[at] = _is_inside(block, size) and block not in taken
        if next_blocks < blocks:
            score += 1 if fits[at] else -1
            taken.add(block)
    return _Replayed(score, fits)


def _is_inside(cell: Cell, size: int) -> bool:
    return 0 <= cell[0] < size and 0 <= cell[1] < size
