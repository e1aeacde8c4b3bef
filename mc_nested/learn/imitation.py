"""Self-imitation: each run's best episode so far takes part in every batch, and its actions are to be the greedy ones.

The large-margin loss of deep Q-learning from demonstrations (Hester et al., 2018), the demonstrations being a run's own
best episode: max_a [Q(s, a) + margin · (a ≠ a*)] - Q(s, a*).
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats
from mc_nested.learn.replay import Transitions

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


class BestEpisodes:
    """The best episode of each row, as transitions.

    Args:
        rows: how many rows.
        longest: steps of the longest episode.
        share: how many transitions of a batch are to be theirs.
    """

    def __init__(self, rows: int, longest: int, share: int) -> None:
        self.share = share
        real = [np.zeros((rows, longest), dtype=np.float32) for _ in range(2)]
        whole = np.zeros((2, rows, longest), dtype=np.int64), np.zeros((rows, longest), dtype=np.int64)
        self._kept = Transitions(*whole, *real)
        self._length = np.zeros(rows, dtype=np.int64)

    def keep(self, row: int, episode: Transitions) -> None:
        """Take the episode (steps,) as that row's best."""
        self._length[row] = len(episode.actions)
        for kept, new in zip(self._kept, episode, strict=True):
            kept[..., row, : new.shape[-1]] = new

    def forget(self, row: int) -> None:
        """That row's best episode is another row's now."""
        self._length[row] = 0

    def mix_in(self, rows: Ints, drawn: Transitions, uniforms: NDArray[np.float64]) -> Bools:
        """Put steps of the best episodes in the place of the first transitions drawn, (k, batch).

        ``uniforms`` (k, batch) say which; returns which transitions are imitated, (k, batch). A row without a best
        episode keeps what was drawn.
        """
        share, length = self.share, self._length[rows]
        imitated = np.zeros(drawn.actions.shape, dtype=np.bool_)
        imitated[:, :share] = length[:, None] > 0
        steps = (uniforms[:, :share] * length[:, None]).astype(np.int64)
        for kept, own in zip(self._kept, drawn, strict=True):
            own[..., :share] = np.where(imitated[:, :share], kept[..., rows[:, None], steps], own[..., :share])
        return imitated


@njit(cache=True, error_model="numpy")
def rival(values: Floats, action: int, margin: float) -> int:
    """The action that the large-margin loss pushes down for ``action`` to be greedy, of values (actions,).

    ``action`` itself where it is greedy by the margin already.
    """
    highest = action
    for other in range(len(values)):
        own = values[highest] + (margin if highest != action else 0.0)
        if other != action and values[other] + margin > own:
            highest = other
    return highest
