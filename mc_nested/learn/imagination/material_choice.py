"""The main agent learns its choice from imagined scores: what an episode of each material would bring."""

from collections.abc import Collection

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.dqn.engine import Batch
from mc_nested.learn.learner import Learner

LAST = 3
"""A material brings the mean of so many episodes: fewer would follow a change sooner, more would outvote an odd one."""

MOST_UPDATES, CLOSE = 3000, 0.25
"""Updates at most, once an episode; it ends earlier once every value is as close as this to the imagined score."""


def scores_of_materials(
    extras: Float64s, materials: int, blocks: int, most: float, elsewhere: Collection[int] = ()
) -> Float64s:
    """Return the imagined score of each material, (materials,): the most that the blocks could bring, and what it adds.

    ``extras`` (episodes, 2) are materials and what they brought beside the blocks. A material that was never tried is
    taken optimistically: it is worth as many blocks more than the best that was. While it is tried ``elsewhere``, in
    another game, it is worth as many less.
    """
    beside = np.full(materials, np.nan)
    for material in range(materials):
        of_material = extras[extras[:, 0] == material, 1]
        if len(of_material):
            beside[material] = of_material[-LAST:].mean()
    best = float(np.nanmax(beside)) if np.isfinite(beside).any() else 0.0
    untried = np.full(materials, best + blocks)
    untried[list(elsewhere)] = best - blocks
    scores: Float64s = most + np.where(np.isfinite(beside), beside, untried)
    return scores


def learn_choice(main: Learner, row: int, start: Int64s, scores: Float64s) -> None:
    """Update that row of the main agent until its values of the start state (3,) are the scores (materials,)."""
    rows, state = np.array([row]), main.states.encoded(start[None])
    batch = main.engine.rule.batch
    actions = np.arange(batch) % len(scores)
    imagined = Batch(
        states=np.broadcast_to(state, (2, 1, batch)).copy(),
        actions=actions[None],
        rewards=scores[actions].astype(np.float32)[None],
        discounts=np.zeros((1, batch), np.float32),
        imitated=np.zeros((1, batch), np.bool_),
        weights=np.ones((1, batch), np.float32),
    )
    for _ in range(MOST_UPDATES):
        if np.abs(main.engine.update(rows, imagined)).max() <= CLOSE:
            return
