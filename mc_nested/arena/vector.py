"""The vector form of ArenaEnv over any games: what a trainer sees of one live game, or of as many as there are.

Autoreset is disabled. ``reset(options={"reset_mask": bool (R,), "material": int (R,)})`` begins an episode in the
masked arenas; an arena whose episode has ended stands still until then: its reward is 0 and its flags stay up.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.rules import Cell
from mc_nested.arena.scenario import Scenario

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

METADATA: dict[str, Any] = {"autoreset_mode": AutoresetMode.DISABLED}
"""Autoreset is off: the trainer says which arenas begin an episode, and with which material."""

NO_ACTION = -1
"""In the place of an action: that arena stands still, and no step is counted."""


@runtime_checkable
class ResumableEnv(Protocol):
    """Arenas whose episodes can be saved half-way: the simulator's. A live game's can't, they begin anew."""

    def snapshot(self) -> dict[str, NDArray[Any]]: ...

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> Ints: ...


class ArenaVectorEnv(VectorEnv[Ints, Ints, Any]):
    """Arenas of one scenario, each an ArenaEnv over a game of its own, stepped one after the other."""

    metadata = METADATA

    def __init__(self, envs: Sequence[ArenaEnv]) -> None:
        self.envs = tuple(envs)
        self.num_envs = len(self.envs)
        self.scenario = self.envs[0].scenario
        self.single_observation_space, self.single_action_space = (
            self.envs[0].observation_space,
            self.envs[0].action_space,
        )
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._observations = np.zeros((self.num_envs, 3), dtype=np.int64)
        self._terminated = np.zeros(self.num_envs, dtype=np.bool_)
        self._truncated = np.zeros(self.num_envs, dtype=np.bool_)

    def placed(self, run: int) -> frozenset[Cell]:
        """The cells where a block landed in that arena since its last reset."""
        return self.envs[run].placed

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Ints, dict[str, Any]]:
        """Begin an episode in the masked arenas (all, without a mask), each with its material (the best, without)."""
        mask, materials = reset_options(options, [env.scenario for env in self.envs])
        seeds = seed if isinstance(seed, list) else [seed] * self.num_envs
        for run in np.flatnonzero(mask):
            name = self.scenario.materials[materials[run]].name
            self._observations[run], _ = self.envs[run].reset(seed=seeds[run], options={"material": name})
        self._terminated[mask] = self._truncated[mask] = False
        return self._observations.copy(), {}

    def step(self, actions: Ints) -> tuple[Ints, Floats, Bools, Bools, dict[str, Any]]:
        """One action, or NO_ACTION, in every arena whose episode runs; ``info["score"]`` is r_M where ``_score``."""
        rewards = np.zeros(self.num_envs)
        scores = np.zeros(self.num_envs)
        ended = np.zeros(self.num_envs, dtype=np.bool_)
        running = ~(self._terminated | self._truncated)
        for run in np.flatnonzero(running & (actions != NO_ACTION)):
            self._observations[run], rewards[run], self._terminated[run], self._truncated[run], info = self.envs[
                run
            ].step(actions[run])
            if "score" in info:
                scores[run], ended[run] = info["score"], True
        flags = self._terminated.copy(), self._truncated.copy()
        return self._observations.copy(), rewards, *flags, {"score": scores, "_score": ended}


def reset_options(options: dict[str, Any] | None, scenarios: Sequence[Scenario]) -> tuple[Bools, Ints]:
    """The mask (R,) and the materials (R,) of a vector reset, with their defaults filled in.

    ValueError where an array doesn't have one entry per run, or a material's index doesn't exist.
    """
    runs = len(scenarios)
    options = options or {}
    mask = np.asarray(options["reset_mask"] if "reset_mask" in options else np.ones(runs), dtype=np.bool_)
    materials = options.get("material")
    if materials is None:
        materials = [scenario.best_material for scenario in scenarios]
    materials = np.asarray(materials, dtype=np.int64)
    if mask.shape != (runs,) or materials.shape != (runs,):
        raise ValueError(f"reset_mask and material need one entry for each of the {runs} runs")
    begun = np.flatnonzero(mask).tolist()
    if any(not 0 <= materials[run] < len(scenarios[run].materials) for run in begun):
        raise ValueError("material: an index that the scenario doesn't have")
    return mask, materials
