"""Each run's own random numbers: a pure function of the seed, the run and the tick, so that nothing has to be saved.

A run's numbers don't depend on how many runs train beside it, nor on where a training was interrupted.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

TICKS_A_CHUNK = 256
"""Ticks whose numbers are drawn at once; part of what a seed means, so a change gives other runs."""

INITIAL = 0
TICKS = 1
"""What a stream is for: a run's initial parameters, or its ticks."""


def initial_stream(seed: int, run: int) -> np.random.Generator:
    """The generator of a run's initial parameters."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, INITIAL))))


class Streams:
    """Uniform numbers in [0, 1) for every run at every tick.

    Args:
        seed: the training's seed, not negative.
        runs: each run's number, the same wherever and beside whatever it trains.
        width: numbers that a run needs at a tick.
    """

    def __init__(self, seed: int, runs: Sequence[int], width: int) -> None:
        self._seed = seed
        self._runs = runs
        self._chunk = -1
        self._numbers = np.empty((len(runs), TICKS_A_CHUNK, width))

    def at(self, tick: int) -> NDArray[np.float64]:
        """The numbers of that tick, (runs, width)."""
        chunk, within = divmod(tick, TICKS_A_CHUNK)
        if chunk != self._chunk:
            for numbers, run in zip(self._numbers, self._runs, strict=True):
                key = np.random.SeedSequence(self._seed, spawn_key=(run, TICKS, chunk))
                np.random.Generator(np.random.PCG64(key)).random(out=numbers)
            self._chunk = chunk
        return self._numbers[:, within]
