"""Vector arenas that begin their next episode by themselves, as Gymnasium's own vector envs do by default."""

from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv, VectorWrapper

from mc_nested.arrays import Bools, Float64s, Int64s


class NextStepAutoreset(VectorWrapper[Int64s, Int64s, Int64s, Int64s, Any]):
    """Arenas whose next episode begins at the step after the last: that step's action isn't done, its reward is 0.

    The new episode's material is the best one, as after a reset without options.

    Args:
        env: the arenas, autoreset disabled.
    """

    def __init__(self, env: VectorEnv[Int64s, Int64s, Any]) -> None:
        super().__init__(env)
        self.metadata = {**env.metadata, "autoreset_mode": AutoresetMode.NEXT_STEP}
        self._ended: Bools | None = None

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in every arena, or in those of ``options["reset_mask"]``."""
        observations, info = self.env.reset(seed=seed, options=options)  # type: ignore[arg-type]  # Gymnasium's own take lists
        begun = (options or {}).get("reset_mask", True)
        self._ended = (np.zeros(self.num_envs, np.bool_) if self._ended is None else self._ended) & ~np.asarray(begun)
        return observations, info

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """One action in every arena whose episode runs, and a reset of every other; flags and rewards are this step's.

        ResetNeeded before the first reset; ValueError if there isn't one action for each arena.
        """
        if self._ended is None:
            raise ResetNeeded("no episode has begun: call reset() first")
        chosen = np.asarray(actions)
        if not self.action_space.contains(chosen):
            one = "an action and a material" if self.action_space.shape == (self.num_envs, 2) else "one of 0 to 7"
            raise ValueError(f"actions needs {one} for each of the {self.num_envs} arenas, not {actions}")
        again = self._ended
        observations, rewards, terminated, truncated, info = self.env.step(chosen)
        if again.any():
            observations, _ = self.env.reset(options={"reset_mask": again})
        terminated, truncated = terminated & ~again, truncated & ~again
        self._ended = terminated | truncated
        return observations, rewards, terminated, truncated, info
