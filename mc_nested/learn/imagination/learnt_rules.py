"""What the agent's own transitions say about moving and placing: each rule is what most of them agree on.

Taken as known: the arena is a grid of the cells that observations can name, what was placed stays, and nobody enters
the cell of a block. Learnt: where each action leads, which actions place a block, where it lands, and which cells are
walls: solid, though nothing was built there.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools, Int64s
from mc_nested.learn.imagination.noticing import Assumption, paid_otherwise

REACH = 1
"""How far from the agent a block can land, in cells along each axis."""

PLACES_ABOVE = 0.5
"""An action places a block if it used one in more than this share of its tries where a block could land."""


CLEAR = 2
"""How many votes an action's commonest step must be ahead by, where actions slip."""

FADES = 0.7
"""The weight of a try once there is a later one of the same cell: above a half, two tries outvote an odd one."""

WALL_ABOVE, WALL_ABOVE_WITH_SLIPS = 0.0, 1.0
"""A cell is a wall where what was stopped there outweighs what wasn't by more: one stop may be a slip, two are not."""


@dataclass(frozen=True)
class LearntRules:
    """The rules as learnt so far.

    ``moves`` (actions, 2) is the cells that each action's move covers, ``known`` (actions,) whether it was ever seen to
    move, ``places`` (actions,) whether it places a block after it, ``lands`` where: cells from the agent. ``walls``
    (size, size) are solid from the beginning. ``astray`` (steps,) has the Assumption that each of the transitions speaks
    against, HOLDS where it is as these rules say.
    """

    moves: Int64s
    known: Bools
    places: Bools
    lands: Cell
    walls: Bools
    astray: Int64s


def learn_rules(steps: Int64s, first_of_episode: Int64s, actions: int, size: int) -> LearntRules:
    """Return the rules that most transitions (steps, 9) (experience.py) of a ``size`` x ``size`` arena agree on."""
    moves, known = _learn_moves(steps, actions)
    around = [
        (right, forward)
        for right in range(-REACH, REACH + 1)
        for forward in range(-REACH, REACH + 1)
        if (right, forward) != (0, 0)
    ]
    seen = _Seen.of(steps, first_of_episode, moves, size, slips=bool(unclear_moves(steps, actions).any()))
    best = max((_explain(seen, lands, actions) for lands in around), key=lambda explained: explained.score)
    return LearntRules(moves, known, best.places, best.lands, best.walls, _astray(seen, best, moves))


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


class _Seen(NamedTuple):
    """Transitions as they are replayed, an entry for each step.

    ``bumps`` are the cells inside that an action led to though the agent stayed, None where it didn't; ``after`` where
    the agent was then. ``slips``: whether actions slip.
    """

    steps: Int64s
    begins: list[bool]
    bumps: list[Cell | None]
    after: list[Cell]
    used: Bools
    size: int
    slips: bool

    @classmethod
    def of(cls, steps: Int64s, first_of_episode: Int64s, moves: Int64s, size: int, *, slips: bool) -> "_Seen":
        """Prepare those transitions (steps, 9), in which the actions' moves are these."""
        begins = np.zeros(len(steps), dtype=np.bool_)
        begins[first_of_episode[first_of_episode < len(steps)]] = True
        ahead = steps[:, 0:2] + moves[steps[:, 3]]
        inside = ((ahead >= 0) & (ahead < size)).all(axis=1)
        stayed = (steps[:, 0:2] == steps[:, 4:6]).all(axis=1)
        bumped = inside & stayed & (ahead != steps[:, 0:2]).any(axis=1)
        bumps = [(x, y) if hit else None for (x, y), hit in zip(ahead.tolist(), bumped.tolist(), strict=True)]
        after = [(x, y) for x, y in steps[:, 4:6].tolist()]
        return cls(steps, begins.tolist(), bumps, after, steps[:, 2] > steps[:, 6], size, slips)


class _Explained(NamedTuple):
    """How well a place for blocks explains what happened, with the actions that place and the walls that go with it.

    ``blocked`` and ``misplaced`` are steps that it doesn't explain: the agent went through a block, or was stopped
    where it isn't always; a block landed where none could, or didn't where others did.
    """

    score: int
    lands: Cell
    places: Bools
    walls: Bools
    blocked: list[int]
    misplaced: list[int]


def _explain(seen: _Seen, lands: Cell, actions: int) -> _Explained:
    """Replay the transitions with blocks that land at ``lands`` from the agent.

    A step speaks for it where a walker was stopped by a block that landed there, or a block was used and that cell was
    free; against it where a walker went through such a block, was stopped by nothing, or that cell was taken. Walls
    explain what was stopped by nothing; each speaks against it once, and so does whatever went through one. What was
    paid says nothing here: wherever blocks land, as many cells are paid.
    """
    score, taken, through = 0, set[Cell](), list[int]()
    bumps: list[tuple[int, Cell]] = []
    fits = np.zeros(len(seen.steps), dtype=np.bool_)
    (right, forward), size = lands, seen.size
    parts = zip(seen.begins, seen.bumps, seen.after, seen.used.tolist(), strict=True)
    for at, (begins, bump, after, used) in enumerate(parts):
        if begins:
            taken = set()
        if after in taken:
            through.append(at)
        elif bump in taken:
            score += 1
        elif bump:
            bumps.append((at, bump))
        block = (after[0] + right, after[1] + forward)
        fits[at] = 0 <= block[0] < size and 0 <= block[1] < size and block not in taken
        if used:
            score += 1 if fits[at] else -1
            taken.add(block)
    landing, did = seen.steps[:, 4:6] + np.array(lands), seen.steps[:, 3]
    walls, _, _ = _find_walls(seen, bumps, landing)
    places, _ = _learn_places(seen, fits & ~_at(walls, landing), actions)
    refused = np.flatnonzero(fits & ~seen.used & places[did])
    refusals = [(at, (x, y)) for at, (x, y) in zip(refused.tolist(), landing[refused].tolist(), strict=True)]
    walls, against, unclear = _find_walls(seen, [*bumps, *refusals], landing)
    places, odd = _learn_places(seen, fits & ~_at(walls, landing), actions)
    blocked = [*through, *(at for at, _ in bumps if at in unclear)]
    misplaced = np.flatnonzero(seen.used & ~(fits & places[did])).tolist()
    misplaced += [at for at, _ in refusals if at in unclear]
    return _Explained(score - len(through) - against - odd, lands, places, walls, blocked, misplaced)


def _learn_places(seen: _Seen, fits: Bools, actions: int) -> tuple[Bools, int]:
    """Return which actions place a block (actions,), from the steps where one could land (steps,).

    And how many of those tries were odd: where a block can land, an action places one always or never.
    """
    tries = np.bincount(seen.steps[fits, 3], minlength=actions)
    uses = np.bincount(seen.steps[fits & seen.used, 3], minlength=actions)
    # An action that was never tried where a block could land is taken to place one: trying it will tell.
    places: Bools = uses > PLACES_ABOVE * tries - (tries == 0)
    return places, int(np.minimum(uses, tries - uses).sum())


def _find_walls(seen: _Seen, stops: list[tuple[int, Cell]], landing: Int64s) -> tuple[Bools, int, set[int]]:
    """Return the cells that are walls (size, size), how much speaks against them, and the stops that aren't always so.

    ``stops`` are the steps in which something was stopped that no block explains, and the cell; what went into a cell,
    the agent or its block at ``landing`` (steps, 2), speaks for its being free.
    """
    walls, against, unclear = np.zeros((seen.size, seen.size), dtype=np.bool_), 0, set[int]()
    for cell in {cell for _, cell in stops}:
        stopped = [at for at, where in stops if where == cell]
        went = (seen.steps[:, 4:6] == cell).all(axis=1) | (seen.used & (landing == cell).all(axis=1))
        went[stopped] = False
        free = np.flatnonzero(went)
        later = np.argsort(np.argsort(np.concatenate((stopped, free)), kind="stable"))
        weights = FADES ** (len(later) - 1.0 - later)
        lead = weights[: len(stopped)].sum() - weights[len(stopped) :].sum()
        walls[cell] = lead > (WALL_ABOVE_WITH_SLIPS if seen.slips else WALL_ABOVE)
        against += 1 + len(free) if walls[cell] else len(stopped)
        unclear |= set(stopped) if len(free) else set()
    return walls, against, unclear


def _astray(seen: _Seen, explained: _Explained, moves: Int64s) -> Int64s:
    """Return the Assumption that each step speaks against, (steps,)."""
    astray = paid_otherwise(seen.steps)
    astray[explained.misplaced] = Assumption.LANDS
    astray[explained.blocked] = Assumption.SOLID
    shifts = seen.steps[:, 4:6] - seen.steps[:, 0:2]
    astray[shifts.any(axis=1) & (shifts != moves[seen.steps[:, 3]]).any(axis=1)] = Assumption.MOVES
    return astray


def _at(cells: Bools, where: Int64s) -> Bools:
    """Return what ``cells`` (size, size) say at those places (k, 2); False outside."""
    inside = ((where >= 0) & (where < len(cells))).all(axis=1)
    at = np.where(inside[:, None], where, 0)
    found: Bools = inside & cells[at[:, 0], at[:, 1]]
    return found
