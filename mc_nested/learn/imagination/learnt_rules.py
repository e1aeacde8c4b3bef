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

REACH, FURTHER = 1, 2
"""How far from the agent a block can land, in cells along each axis; and how far it is looked whether it does, too."""

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
    (size, size) are solid from the beginning. ``astray`` (steps,) has the Assumption that each transition speaks
    against, HOLDS where it speaks against none.
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
    shifts = steps[:, 4:6] - steps[:, 0:2]
    otherwise = shifts.any(axis=1) & (shifts != moves[steps[:, 3]]).any(axis=1)
    seen = _seen(steps, first_of_episode, moves, size, slips=bool(otherwise.any()))
    around = np.argwhere(np.ones((2 * FURTHER + 1,) * 2)) - FURTHER
    explained = [_explain(seen, (right, forward), actions) for right, forward in around.tolist()]
    near = [each for each in explained if 0 < max(map(abs, each.lands)) <= REACH]
    # Until a block was used, all that is known is where none could land: where all could, no action would place any.
    best = max(near, key=lambda each: (each.score, seen.used.any() or each.places.sum()))
    astray = np.maximum(paid_otherwise(steps), best.astray * seen.is_new)
    # A wall speaks against each place once, though it may be there; another place might make do without.
    if max(each.score for each in explained) > best.score + np.count_nonzero(best.walls) + CLEAR * seen.slips:
        astray[:] = Assumption.LANDS
    of_another = (shifts[:, None] == moves[known]).all(axis=2).any(axis=1) | ~known.all()
    astray[otherwise] = np.where(of_another, Assumption.SLIPS, Assumption.MOVES)[otherwise]
    return LearntRules(moves, known, best.places, best.lands, best.walls, astray)


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
    """Transitions, (steps,) each, in an arena with a border of FURTHER cells, where one index names a cell.

    ``episode`` counts them, ``did`` are actions, and ``is_new`` where that wasn't done before in this episode, in that
    cell with as many blocks: who goes round shows nothing new. ``used`` says whether a block was. ``after`` is where
    the agent was then, ``ahead`` where the action led to, ``bumped`` whether that is inside and the agent stayed.
    ``inside`` (cells,) is False in the border; ``slips``: whether actions slip.
    """

    episode: Int64s
    did: Int64s
    is_new: Bools
    used: Bools
    after: Int64s
    ahead: Int64s
    bumped: Bools
    inside: Bools
    side: int
    slips: bool


def _seen(steps: Int64s, first_of_episode: Int64s, moves: Int64s, size: int, *, slips: bool) -> _Seen:
    """Return the transitions (steps, 9), in which the actions' moves are these, to be replayed."""
    side, ahead = size + 2 * FURTHER, steps[:, 0:2] + moves[steps[:, 3]]
    strides = np.array([side, 1])
    inside = np.pad(np.ones((size, size), dtype=np.bool_), FURTHER).ravel()
    here, after, at = (
        (np.clip(cells, -FURTHER, size) + FURTHER) @ strides for cells in (steps[:, 0:2], steps[:, 4:6], ahead)
    )
    episode = np.searchsorted(first_of_episode, np.arange(len(steps)), side="right")
    bumped = (here == after) & (at != here) & inside[at]
    is_new = np.zeros(len(steps), dtype=np.bool_)
    is_new[np.unique(np.column_stack((episode, steps[:, :4])), axis=0, return_index=True)[1]] = True
    return _Seen(episode, steps[:, 3], is_new, steps[:, 2] > steps[:, 6], after, at, bumped, inside, side, slips)


class _Explained(NamedTuple):
    """How well a place for blocks explains what happened, with the actions that place and the walls that go with it.

    ``astray`` as of LearntRules: the agent went through a block, or was stopped where it isn't always; a block landed
    where none could, or didn't where others did.
    """

    score: int
    lands: Cell
    places: Bools
    walls: Bools
    astray: Int64s


def _explain(seen: _Seen, lands: Cell, actions: int) -> _Explained:
    """Replay the transitions with blocks that land at ``lands`` from the agent.

    A step speaks for it where a walker was stopped by a block that landed there, or a block was used and that cell was
    free; against it where a walker went through such a block, was stopped by nothing, or that cell was taken. Walls
    explain what was stopped by nothing; each speaks against it once, and so does whatever went through one. What was
    paid says nothing here: wherever blocks land, as many cells are paid.
    """
    time, landing = np.arange(len(seen.did)), seen.after + lands[0] * seen.side + lands[1]
    built_at = np.full((int(seen.episode.max(initial=0)) + 1, len(seen.inside)), len(time))
    np.minimum.at(built_at, (seen.episode[seen.used], landing[seen.used]), time[seen.used])
    through, stopped, taken = (built_at[seen.episode, at] < time for at in (seen.after, seen.ahead, landing))
    bumped, fits = seen.bumped & ~through, seen.inside[landing] & ~taken
    bumps = bumped & ~stopped
    walls, _, _ = _find_walls(seen, landing, bumps & seen.is_new, np.zeros_like(bumps))
    places, _ = _learn_places(seen, fits & ~walls[landing], actions)
    refused = fits & ~seen.used & places[seen.did]
    walls, against, unclear = _find_walls(seen, landing, bumps & seen.is_new, refused & seen.is_new)
    places, odd = _learn_places(seen, fits & ~walls[landing], actions)
    astray = np.where(seen.used & ~(fits & places[seen.did]) | refused & unclear[landing], Assumption.LANDS, 0)
    astray[through | bumps & unclear[seen.ahead]] = Assumption.SOLID
    score = np.count_nonzero(bumped & stopped & seen.is_new) + np.count_nonzero(seen.used & fits)
    score -= np.count_nonzero(through & seen.is_new) + np.count_nonzero(seen.used & ~fits) + against + odd
    within = walls.reshape(seen.side, seen.side)[FURTHER:-FURTHER, FURTHER:-FURTHER]
    return _Explained(score, lands, places, within, astray)


def _learn_places(seen: _Seen, fits: Bools, actions: int) -> tuple[Bools, int]:
    """Return which actions place a block (actions,), from the steps where one could land (steps,).

    And how many of those tries were odd: where a block can land, an action places one always or never.
    """
    fits &= seen.is_new
    tries = np.bincount(seen.did[fits], minlength=actions)
    uses = np.bincount(seen.did[fits & seen.used], minlength=actions)
    # An action that was never tried where a block could land is taken to place one: trying it will tell.
    places: Bools = uses > PLACES_ABOVE * tries - (tries == 0)
    return places, int(np.minimum(uses, tries - uses).sum())


def _find_walls(seen: _Seen, landing: Int64s, bumps: Bools, refused: Bools) -> tuple[Bools, int, Bools]:
    """Return which cells are walls (cells,), how much speaks against them, and what stops now and then (cells,).

    In the steps ``bumps`` the agent, in those ``refused`` a block at ``landing`` was stopped though no block was there;
    what goes into a cell, the agent or its block, speaks for its being free.
    """
    walls, unclear, against = np.zeros_like(seen.inside), np.zeros_like(seen.inside), 0
    for cell in np.union1d(seen.ahead[bumps], landing[refused]).tolist():
        stops = bumps & (seen.ahead == cell) | refused & (landing == cell)
        frees = ~stops & ((seen.after == cell) | seen.used & (landing == cell))
        votes = (stops.astype(np.int64) - frees)[stops | frees]
        lead = float(votes @ FADES ** np.arange(len(votes))[::-1])
        walls[cell] = lead > (WALL_ABOVE_WITH_SLIPS if seen.slips else WALL_ABOVE)
        unclear[cell] = frees.any()
        against += 1 + np.count_nonzero(frees) if walls[cell] else np.count_nonzero(stops)
    return walls, against, unclear
