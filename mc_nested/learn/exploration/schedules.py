"""ε of an ε-greedy agent, which falls with the episodes it has completed (paper, section 4.2)."""

from dataclasses import dataclass

import numpy as np

from mc_nested.arrays import Float64s, Int64s


@dataclass(frozen=True)
class LinearDecay:
    """ε falls linearly from ``start`` to ``floor`` over the first ``share`` of the episodes, and stays there."""

    start: float
    floor: float
    share: float

    def epsilon(self, episodes_done: Int64s, episodes: int) -> Float64s:
        """ε of each run after that many of ``episodes`` episodes, the shape of ``episodes_done``."""
        progress = np.minimum(episodes_done / (self.share * episodes), 1.0)
        return self.start + (self.floor - self.start) * progress
