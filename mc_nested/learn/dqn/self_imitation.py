"""Self-imitation: each run's best episode so far is part of every batch, and its actions should become greedy.

The large-margin loss of deep Q-learning from demonstrations (Hester et al., 2018), where the demonstration is the run's
own best episode: max_a [Q(s, a) + margin · (a ≠ a*)] - Q(s, a*).
"""

import numpy as np

from mc_nested.arrays import Bools, Float32s, Float64s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.replay import Transitions


class BestEpisodes:
    """The best episode of each row, as transitions.

    Args:
        rows: how many rows.
        longest: steps of the longest episode.
        share: how many transitions of a batch are taken from it.
    """

    def __init__(self, rows: int, longest: int, share: int) -> None:
        self.share = share
        real = [np.zeros((rows, longest), dtype=np.float32) for _ in range(2)]
        whole = np.zeros((2, rows, longest), dtype=np.int64), np.zeros((rows, longest), dtype=np.int64)
        self._kept = Transitions(*whole, *real)
        self._length = np.zeros(rows, dtype=np.int64)

    def keep(self, row: int, episode: Transitions) -> None:
        """Keep the episode (steps,) as that row's best."""
        self._length[row] = len(episode.actions)
        for kept, new in zip(self._kept, episode, strict=True):
            kept[..., row, : new.shape[-1]] = new

    def forget(self, row: int) -> None:
        """Drop that row's best episode: the best is another row's now."""
        self._length[row] = 0

    def replaced(self, rows: Int64s) -> Int64s:
        """Return how many of the sampled transitions ``mix_in`` replaces in each of the named rows (k,)."""
        return np.where(self._length[rows] > 0, self.share, 0)

    def mix_in(self, rows: Int64s, drawn: Transitions, uniforms: Float64s) -> Bools:
        """Replace the first of the sampled transitions (k, batch) by steps of the best episodes.

        ``uniforms`` (k, batch) select them. Returns which transitions are imitated, (k, batch). A row without a best
        episode keeps what was sampled.
        """
        share, length = self.share, self._length[rows]
        imitated = np.zeros(drawn.actions.shape, dtype=np.bool_)
        imitated[:, :share] = length[:, None] > 0
        steps = (uniforms[:, :share] * length[:, None]).astype(np.int64)
        for kept, own in zip(self._kept, drawn, strict=True):
            own[..., :share] = np.where(imitated[:, :share], kept[..., rows[:, None], steps], own[..., :share])
        return imitated


@compiled()
def rival(values: Float32s, action: int, margin: float) -> int:
    """Return the action that the large-margin loss pushes down for ``action`` to be greedy, of values (actions,).

    ``action`` itself where it is greedy by the margin already.
    """
    highest = action
    for other in range(len(values)):
        own = values[highest] + (margin if highest != action else 0.0)
        if other != action and values[other] + margin > own:
            highest = other
    return highest
