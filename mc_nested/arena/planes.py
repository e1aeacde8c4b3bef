"""The arena seen from above, as planes of bytes (paper, section 4.1: nested agents "applicable with inputs of images").

Drawn from what was confirmed: where the agent stands, and which blocks are known to have landed. So a live game has
them as a simulated one has. In a plane, (x, y) is a cell; what holds for the whole arena fills a plane.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import VectorEnv, VectorWrapper
from gymnasium.vector.utils import batch_space

from mc_nested.arena.env import BLOCKS_LEFT, X, Y
from mc_nested.arena.game import Resumable
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import resumable_arenas
from mc_nested.arrays import Bools, Bytes, Float64s, Int64s
from mc_nested.errors import ScenarioError

AGENT, PLACED, LEFT, START = range(4)
"""The planes: where the agent stands, what was placed, the share of blocks left, and where the episode began."""

PLANES = 4
"""How many planes every agent sees; a fifth holds the material, for an agent that sees it."""

FULL = 255
"""A cell where something is, or a whole share."""


def planes_of(observations: Int64s, occupied: Bools, starts: Int64s, blocks: Int64s) -> Bytes:
    """Return the planes of arenas (runs, PLANES, size, size).

    Args:
        observations: x, y and b of each, (runs, 3 or more).
        occupied: where blocks stand, (runs, size, size).
        starts: the start cells, (runs, 2).
        blocks: how many blocks each design needs, (runs,).
    """
    runs, size, _ = occupied.shape
    planes = np.zeros((runs, PLANES, size, size), np.uint8)
    every = np.arange(runs)
    planes[every, AGENT, observations[:, X], observations[:, Y]] = FULL
    planes[:, PLACED] = np.where(occupied, FULL, 0)
    planes[:, LEFT] = shares(observations[:, BLOCKS_LEFT], blocks)[:, None, None]
    planes[every, START, starts[:, 0], starts[:, 1]] = FULL
    return planes


def shares(numbers: Int64s, highest: Int64s | int) -> Bytes:
    """Return numbers from 0 to their highest as bytes from 0 to FULL."""
    return np.round(FULL * numbers / highest).astype(np.uint8)


def with_material(planes: Bytes, values: Bytes) -> Bytes:
    """Return the planes (runs, planes, size, size) and one more, which each run's value (runs,) fills."""
    more = np.empty((len(planes), 1, *planes.shape[2:]), np.uint8)
    more[:] = values[:, None, None, None]
    return np.concatenate((planes, more), axis=1)


def start_planes(scenarios: Sequence[Scenario]) -> Bytes:
    """Return the planes of the scenarios before the first move, (runs, PLANES, size, size)."""
    size = common_size(scenarios)
    starts = np.array([scenario.start_state for scenario in scenarios])
    nothing = np.zeros((len(scenarios), size, size), np.bool_)
    return planes_of(starts, nothing, starts[:, :2], starts[:, BLOCKS_LEFT])


def common_size(scenarios: Sequence[Scenario]) -> int:
    """Return the cells a side that all arenas have; ScenarioError if they differ."""
    sizes = {scenario.size for scenario in scenarios}
    if len(sizes) > 1:
        raise ScenarioError(f"arenas of {sorted(sizes)} cells a side: images have one size, train them one by one")
    return sizes.pop()


class PlanesVectorEnv(VectorWrapper):
    """Arenas whose observations are planes; for the single agent, its m fills a fifth.

    Args:
        env: the arenas, or the single agent's view of them; they say where blocks stand (``occupied``).
        scenarios: each run's scenario; all arenas have one size.
    """

    def __init__(self, env: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario]) -> None:
        super().__init__(env)
        size = common_size(scenarios)
        self._starts = np.array([scenario.start for scenario in scenarios])
        self._blocks = np.array([scenario.blocks for scenario in scenarios])
        highest = env.single_observation_space.high  # type: ignore[attr-defined]  # a Box (arena/env.py)
        self._materials = int(highest[-1]) if len(highest) > BLOCKS_LEFT + 1 else None
        planes = PLANES + (self._materials is not None)
        self.single_observation_space = Box(0, FULL, (planes, size, size), np.uint8)
        self.observation_space = batch_space(self.single_observation_space, env.num_envs)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Bytes, dict[str, Any]]:
        """Begin an episode in the masked arenas, as those within."""
        observations, info = self.env.reset(seed=seed, options=options)  # type: ignore[arg-type]  # as VectorEnv's own
        return self._seen(observations), info

    def step(self, actions: Int64s) -> tuple[Bytes, Float64s, Bools, Bools, dict[str, Any]]:
        """Do one action in every running arena, as the arenas within."""
        observations, rewards, terminated, truncated, info = self.env.step(actions)
        return self._seen(observations), rewards, terminated, truncated, info

    @property
    def resumable(self) -> Resumable | None:
        """The arenas within, if they can be resumed: a view has nothing to save."""
        return resumable_arenas(self.env)

    def _seen(self, observations: Int64s) -> Bytes:
        occupied = self.env.occupied()  # type: ignore[attr-defined]  # gymnasium's wrappers hand its methods on
        planes = planes_of(observations, occupied, self._starts, self._blocks)
        if self._materials is None:
            return planes
        return with_material(planes, shares(observations[:, -1], self._materials))
