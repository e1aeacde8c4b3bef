"""Whether the learnt game holds: what its rules can't say, whatever is learnt.

Walls, moves and landings are learnt from all that was seen. So what still doesn't fit isn't something unknown.
"""

from enum import IntEnum

import numpy as np

from mc_nested.arrays import Int64s
from mc_nested.learn.imagination.experience import UNTOLD

EPISODES, SHARE = 3, 0.1
"""In so many episodes in a row more than this share of the steps has to go otherwise: an odd step in twenty is a slip,
and an episode or two are a game that changes."""

RECENT, TWICE = 10, 2
"""Where nothing slips, one in as many of the last ten episodes is enough; of steps that no action makes, two are."""

CHANGES = 2
"""Whether a cell pays may change once."""


class Assumption(IntEnum):
    """What a learnt game takes for granted, as it is named where it isn't so."""

    HOLDS = 0
    MOVES = 1
    SOLID = 2
    LANDS = 3
    MATERIAL = 4
    SLIPS = 5


IN_WORDS = {
    Assumption.MOVES: "an action doesn't move alike everywhere",
    Assumption.SOLID: "cells are solid now and then where nothing was built, or blocks aren't",
    Assumption.LANDS: "blocks don't all land in one cell as seen from the agent",
    Assumption.MATERIAL: "what pays depends on the material",
    Assumption.SLIPS: "too many actions do what another does",
}


def broken_assumption(astray: Int64s, first_of_episode: Int64s) -> Assumption:
    """Return what ended episodes speak against; ``astray`` (steps,) has it for each step (learnt_rules.py)."""
    last = np.split(astray, first_of_episode[1:])[-RECENT:]
    slips = bool((astray == Assumption.SLIPS).any())
    often = [np.count_nonzero(part) > SHARE * len(part) for part in last[-EPISODES:]]
    surely = [not slips and part.any() for part in last]
    if np.count_nonzero(astray == Assumption.MOVES) >= TWICE:
        return Assumption.MOVES
    if sum(often) < EPISODES and sum(surely) < EPISODES:
        return Assumption.HOLDS
    return Assumption(int(np.bincount(np.concatenate(last))[1:].argmax()) + 1)


def paid_otherwise(steps: Int64s) -> Int64s:
    """Return what the pay of each transition (steps, 9) speaks against, (steps,).

    A design may change once: a block that is paid, isn't, and is paid again in one place speaks against that being one
    cell; or, where that isn't so of any material alone, against its paying whatever the material.
    """
    astray = np.zeros(len(steps), dtype=np.int64)
    placed = np.flatnonzero((steps[:, 2] > steps[:, 6]) & (steps[:, 7] != UNTOLD))
    for of_material, kind in ((0, Assumption.MATERIAL), (1, Assumption.LANDS)):
        changes = dict[tuple[int, ...], list[int]]()
        for at, (x, y, paid, material) in zip(placed.tolist(), steps[placed][:, [4, 5, 7, 8]].tolist(), strict=True):
            last = changes.setdefault((x, y, of_material * material), [])
            if not last or last[-1] != paid:
                last.append(paid)
                if len(last) > CHANGES:
                    astray[at] = kind
    return astray
