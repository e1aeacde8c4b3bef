"""The main agent learns its choice from imagined scores: what an episode of each material would bring."""

from collections.abc import Collection

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.dqn.engine import lesson
from mc_nested.learn.learner import Learner

LAST = 3
"""A material brings the mean of so many episodes: fewer would follow a change sooner, more would outvote an odd one."""

BUILT = 2
"""Once a whole design was built so often, a material that wasn't played since is tried again."""

MOST_UPDATES, CLOSE = 3000, 0.25
"""Updates at most, once an episode; it ends earlier once every value is as close as this to the imagined score."""


def scores_of_materials(
    extras: Float64s, materials: int, blocks: int, most: float, elsewhere: Collection[int] = ()
) -> Float64s:
    """Return the imagined score of each material, (materials,): the most that the blocks could bring, and what it adds.

    ``extras`` (episodes, 3) are materials, what they brought beside the blocks, and the blocks that were paid. A
    material that was never tried is taken optimistically: it is worth as many blocks more than the best that was. While
    it is tried ``elsewhere``, in another game, it is worth as many less. Once all blocks were paid BUILT times, only
    what was played since then counts, and of a material's episodes those in which all were.
    """
    beside = np.full(materials, np.nan)
    whole = extras[:, 2] >= blocks
    since = extras[np.cumsum(whole) >= BUILT] if np.count_nonzero(whole) >= BUILT else extras
    for material in range(materials):
        of_material = since[since[:, 0] == material]
        built = of_material[of_material[:, 2] >= blocks]
        if len(of_material):
            beside[material] = (built if len(built) else of_material)[-LAST:, 1].mean()
    best = float(np.nanmax(beside)) if np.isfinite(beside).any() else 0.0
    untried = np.full(materials, best + blocks)
    untried[list(elsewhere)] = best - blocks
    return most + np.where(np.isfinite(beside), beside, untried)


def learn_choice(main: Learner, row: int, start: Int64s, scores: Float64s) -> None:
    """Update that row of the main agent until its values of the start state (3,) are the scores (materials,)."""
    rows, batch = np.array([row]), main.engine.rule.batch
    states, actions = main.states.encoded(start[None]).repeat(batch), np.arange(batch) % len(scores)
    imagined = lesson(states, actions, scores[actions].astype(np.float32))
    for _ in range(MOST_UPDATES):
        if np.abs(main.engine.update(rows, imagined)).max() <= CLOSE:
            return
