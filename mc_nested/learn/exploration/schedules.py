"""ε of an ε-greedy agent, which falls with the episodes it has completed (paper, section 4.2)."""

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.learn.preset import Exploration, Preset

NEVER = Exploration(start=0.0, floor=0.0, share=1.0)
"""ε where every real episode is the greedy policy's: exploration follows from the imagination."""

EXCURSIONS_ONLY = Exploration(start=1.0, floor=1.0, share=1.0)
"""The nested agent's ε if every training episode is an excursion: no step is the greedy policy's."""


def decays_of(preset: Preset) -> tuple[Exploration, Exploration]:
    """Return the main and the nested agent's ε in that preset."""
    without = EXCURSIONS_ONLY if preset.excursions else NEVER
    return preset.explore_main or NEVER, preset.explore_nested or without


def epsilon_after(episodes_done: Int64s, episodes: int, rule: Exploration) -> Float64s:
    """Return ε of each run after that many of ``episodes`` episodes, in the shape of ``episodes_done``.

    It falls linearly from the rule's ``start`` to its ``floor`` over its ``share`` of the episodes, and stays there.
    """
    progress = np.minimum(episodes_done / (rule.share * episodes), 1.0)
    return rule.start + (rule.floor - rule.start) * progress
