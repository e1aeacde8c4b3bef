"""Each run's own random numbers: a pure function of the seed, the run and the tick, so that nothing has to be saved.

They don't depend on how many runs train at the same time, nor on when a training was interrupted.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float64s

TICKS_A_CHUNK = 256
"""Ticks whose numbers are drawn at once; another value changes the numbers of every seed."""

INITIAL, TICKS, MAIN_UPDATES, PRACTICE, CHOICES, PLANS, EPISODES = 0, 1, 2, 3, 4, 5, 6
"""What a stream is for: initial parameters, ticks, the main agent's updates after an episode, practice before one,
the main agent's choices within an episode; an episode that a game plays by itself, and what is learnt from it."""


def initial_stream(seed: int, run: int) -> np.random.Generator:
    """Return the generator of a run's initial parameters."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, INITIAL))))


def main_updates_stream(seed: int, run: int, tick: int) -> np.random.Generator:
    """Return the generator of the main agent's batches after the episode of that run that ended at that tick."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, MAIN_UPDATES, tick))))


def choice_stream(seed: int, run: int, tick: int) -> np.random.Generator:
    """Return the generator of the main agent's choice within an episode, after that tick of that run."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, CHOICES, tick))))


def practice_stream(seed: int, run: int, episode: int) -> np.random.Generator:
    """Return the generator of that run's practice before its episode of that number."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, PRACTICE, episode))))


def plan_stream(seed: int, run: int, number: int) -> np.random.Generator:
    """Return the generator of the choices in that run's episode of that number, which a game plays by itself."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, PLANS, number))))


def episode_stream(seed: int, run: int, number: int) -> np.random.Generator:
    """Return the generator of the batches that are learnt from after that run's episode of that number was played."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence(seed, spawn_key=(run, EPISODES, number))))


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
                key = np.random.SeedSequence(self._seed, spawn_key=(run, TICKS, chunk))
                np.random.Generator(np.random.PCG64(key)).random(out=numbers)
            self._chunk = chunk
        return self._numbers[:, within]
