"""Each run's own random numbers: a pure function of the seed, the run and the tick, so that nothing has to be saved.

They don't depend on how many runs train at the same time, nor on when a training was interrupted.
"""

from collections.abc import Sequence
from enum import IntEnum

import numpy as np

from mc_nested.arrays import Float64s

TICKS_A_CHUNK = 256
"""Ticks whose numbers are drawn at once; another value changes the numbers of every seed."""


class Purpose(IntEnum):
    """What a run's random numbers are for."""

    INITIAL = 0  # a run's initial parameters
    TICKS = 1  # all that is drawn in TICKS_A_CHUNK ticks
    MAIN_UPDATES = 2  # the main agent's batches after the episode that ended at a tick
    PRACTICE = 3  # practice before an episode
    CHOICES = 4  # the main agent's choice within an episode, after a tick
    PLANS = 5  # the choices in an episode that a game plays by itself
    EPISODES = 6  # the batches that are learnt from after such an episode was played
    DEMONSTRATIONS = 7  # the batches that are learnt from after an episode was demonstrated at a tick


def stream(purpose: Purpose, seed: int, run: int, *number: int) -> np.random.Generator:
    """Return the generator of a run's numbers for that purpose, at the tick or episode of that number."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, purpose, *number))))


class Streams:
    """Uniform numbers in [0, 1) for every run at every tick.

    Args:
        seed: the training's seed, not negative.
        runs: each run's number, wherever and with whatever other runs it trains.
        width: random numbers that a run needs per tick.
    """

    def __init__(self, seed: int, runs: Sequence[int], width: int) -> None:
        self._seed = seed
        self._runs = runs
        self._chunk = -1
        self._numbers = np.empty((len(runs), TICKS_A_CHUNK, width))

    def at(self, tick: int) -> Float64s:
        """Return the numbers of that tick, (runs, width)."""
        chunk, within = divmod(tick, TICKS_A_CHUNK)
        if chunk != self._chunk:
            self._numbers = np.empty_like(self._numbers)  # those of the last tick may still be in use
            for numbers, run in zip(self._numbers, self._runs, strict=True):
                stream(Purpose.TICKS, self._seed, run, chunk).random(out=numbers)
            self._chunk = chunk
        return self._numbers[:, within]
