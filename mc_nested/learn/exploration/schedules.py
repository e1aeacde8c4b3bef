"""ε of an ε-greedy agent, which falls with the episodes it has completed (paper, section 4.2)."""

from dataclasses import dataclass

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.preset import Exploration, Preset


@dataclass(frozen=True)
class LinearDecay:
    """ε falls linearly from ``start`` to ``floor`` over the first ``share`` of the episodes, and stays there."""

    start: float
    floor: float
    share: float

    def epsilon(self, episodes_done: Int64s, episodes: int) -> Float64s:
        """Return ε of each run after that many of ``episodes`` episodes, in the shape of ``episodes_done``."""
        progress = np.minimum(episodes_done / (self.share * episodes), 1.0)
        return self.start + (self.floor - self.start) * progress


NEVER = LinearDecay(0.0, 0.0, 1.0)
"""ε where every real episode is the greedy policy's: exploration follows from the imagination."""

EXCURSIONS_ONLY = LinearDecay(1.0, 1.0, 1.0)
"""The nested agent's ε if every training episode is an excursion: no step is the greedy policy's."""


def decays_of(preset: Preset) -> tuple[LinearDecay, LinearDecay]:
    """Return the main and the nested agent's ε in that preset."""
    without = EXCURSIONS_ONLY if preset.excursions else NEVER
    return _decay(preset.explore_main, NEVER), _decay(preset.explore_nested, without)


def _decay(exploration: Exploration | None, without: LinearDecay) -> LinearDecay:
    return LinearDecay(exploration.start, exploration.floor, exploration.share) if exploration else without
