"""The vector form of ArenaEnv over any games: what a trainer sees of one live game, or of several games.

Autoreset is disabled. ``reset(options={"reset_mask": bool (R,), "material": int (R,)})`` begins an episode in the
masked arenas; a material may also be the name of one, for all. An arena whose episode has ended does nothing until
then: its reward is 0 and its flags stay set. With parts, actions are (R, 2): each beside the index of the material to
take in hand; or (R,), where the one in hand stays there. NextStepAutoreset has them begin their next episode by
themselves, as Gymnasium's own vector envs do by default.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, VectorEnv, VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.env import RENDERING, ArenaEnv, blank_observations
from mc_nested.arena.game import Resumable
from mc_nested.arena.rules import grid_of
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s

METADATA: dict[str, Any] = {**RENDERING, "autoreset_mode": AutoresetMode.DISABLED}
"""Autoreset is off: the trainer decides which arenas begin an episode, and with which material."""

NO_ACTION = -1
"""Instead of an action: nothing happens in that arena, and no step is counted."""


INSTEAD = "instead"
"""What ``info`` has where a person did another action than the one asked for, and only there."""


def really_done(actions: Int64s, info: Mapping[str, Any]) -> Int64s:
    """Return the actions (R,) that a step with that info did: those asked for, or what a person did instead."""
    return np.where(info[f"_{INSTEAD}"], info[INSTEAD], actions) if INSTEAD in info else actions


def resumable_arenas(env: VectorEnv[Int64s, Int64s, Any]) -> Resumable | None:
    """Return what saves and restores the arenas' episodes half-way; None if they have to start over.

    Arenas say so themselves. A wrapper that doesn't may hold state of its own, so its episodes start over.
    """
    resumable: Resumable | None = getattr(env, "resumable", None)
    return resumable


class Foreseeing(Protocol):
    """Arenas whose games are told what comes after a step, where it goes as the rules say (``ArenaEnv.announce``)."""

    def expected(self, actions: Int64s) -> tuple[Int64s, Bools, Bools]:
        """Return what a step will show by the rules, (R, ...), where it goes on then, and where a choice is due."""

    def announce(self, following: Int64s) -> None:
        """Say what the step after the next one will be, as ``step`` takes it; NO_ACTION where it isn't known."""


def foresees(env: VectorEnv[Any, Int64s, Any]) -> bool:
    """Return whether the arenas are Foreseeing: they say so themselves."""
    return getattr(env, "foresees", False)


class ArenaVectorEnv(VectorEnv[Int64s, Int64s, Any]):
    """Arenas of one scenario, each an ArenaEnv over its own game, stepped one after the other."""

    metadata = METADATA
    foresees = True

    def __init__(self, envs: Sequence[ArenaEnv]) -> None:
        self.envs = tuple(envs)
        self.num_envs = len(self.envs)
        self.render_mode = self.envs[0].render_mode
        self.scenario = self.envs[0].scenario
        self.single_observation_space = self.envs[0].observation_space
        self.single_action_space = self.envs[0].action_space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._observations = blank_observations(self.single_observation_space, self.num_envs)
        self._terminated = np.zeros(self.num_envs, dtype=np.bool_)
        self._truncated = np.zeros(self.num_envs, dtype=np.bool_)

    @property
    def resumable(self) -> Resumable | None:
        """These arenas, if every game can be resumed."""
        return self if all(env.resumable for env in self.envs) else None

    def snapshot(self) -> Arrays:
        """Return every arena as it stands, for ``restore``."""
        arenas = [env.snapshot() for env in self.envs]
        own = {name: getattr(self, name).copy() for name in self._STATE}
        return {**own, **{name: np.stack([arena[name] for arena in arenas]) for name in arenas[0]}}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put every arena back as it stood at ``snapshot``."""
        for name in self._STATE:
            setattr(self, name, snapshot[name].copy())
        for run, env in enumerate(self.envs):
            env.restore({name: kept[run] for name, kept in snapshot.items()})

    _STATE = ("_observations", "_terminated", "_truncated")

    def cell(self, run: int) -> Cell:
        """Return where the agent stands in that arena."""
        return self.envs[run].cell

    def placed(self, run: int) -> frozenset[Cell]:
        """Return the cells where a block landed in that arena since its last reset."""
        return self.envs[run].placed

    def occupied(self) -> Bools:
        """Return the cells where a block landed since each arena's last reset, (runs, size, size)."""
        return np.stack([grid_of(env.placed, env.scenario.size) for env in self.envs])

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in the masked arenas (all, without a mask), each with its material (the best, without)."""
        mask, materials = reset_options(options, [env.scenario for env in self.envs])
        seeds = seeds_of(seed, self.num_envs)
        for run in np.flatnonzero(mask):
            name = self.scenario.materials[materials[run]].name
            self._observations[run], _ = self.envs[run].reset(seed=seeds[run], options={"material": name})
        self._terminated[mask] = self._truncated[mask] = False
        return self._observations.copy(), {}

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """Do one action, or NO_ACTION, in every arena whose episode runs; ``info["score"]`` is r_M if ``_score``.

        With parts, or where a person did another action, ``info`` says more (Info), each with its mask.
        """
        rewards = np.zeros(self.num_envs)
        told = {"score": np.zeros(self.num_envs), INSTEAD: np.full(self.num_envs, NO_ACTION)}
        if self.scenario.parts:
            told |= {"earned": np.zeros(self.num_envs), "chooses": np.zeros(self.num_envs, dtype=np.bool_)}
        masks = {f"_{name}": np.zeros(self.num_envs, dtype=np.bool_) for name in told}
        acts, _ = taken_apart(actions, self.num_envs)
        takes = self._takes(actions)
        running = ~(self._terminated | self._truncated) & (acts != NO_ACTION)
        for run in np.flatnonzero(running):
            self._observations[run], rewards[run], self._terminated[run], self._truncated[run], info = self.envs[
                run
            ].step(takes[run])
            for name in told.keys() & info.keys():
                told[name][run], masks[f"_{name}"][run] = info[name], True
        if not masks[f"_{INSTEAD}"].any():
            del told[INSTEAD], masks[f"_{INSTEAD}"]
        flags = self._terminated.copy(), self._truncated.copy()
        return self._observations.copy(), rewards, *flags, {**told, **masks}

    def expected(self, actions: Int64s) -> tuple[Int64s, Bools, Bools]:
        observations, chooses = self._observations.copy(), np.zeros(self.num_envs, dtype=np.bool_)
        goes_on = ~(self._terminated | self._truncated) & (taken_apart(actions, self.num_envs)[0] != NO_ACTION)
        for run in np.flatnonzero(goes_on):
            observations[run], goes_on[run], chooses[run] = self.envs[run].expected(self._takes(actions)[run])
        return observations, goes_on, chooses

    def announce(self, following: Int64s) -> None:
        known = taken_apart(following, self.num_envs)[0] != NO_ACTION
        for run, takes in enumerate(self._takes(following)):
            self.envs[run].announce(takes if known[run] else None)

    def _takes(self, actions: Int64s) -> Int64s:
        """Return what each Env takes of these actions."""
        return np.asarray(actions) if self.scenario.parts else taken_apart(actions, self.num_envs)[0]

    def render(self) -> tuple[Any, ...] | None:
        """Return every arena as its Env draws it; None without a render mode."""
        return tuple(env.render() for env in self.envs) if self.render_mode else None

    def close_extras(self, **_: Any) -> None:
        """Close every Env."""
        for env in self.envs:
            env.close()


def taken_apart(actions: ArrayLike, runs: int) -> tuple[Int64s, Int64s | None]:
    """Return the actions (R,), and the materials to take in hand before them (R,) where (R, 2) name them.

    ValueError unless they are whole numbers, of every run.
    """
    found = np.asarray(actions)
    if found.dtype.kind not in "iu" or found.shape not in ((runs,), (runs, 2)):
        raise ValueError(f"actions: a whole number for each of the {runs} arenas; with parts a pair, material second")
    whole = found.astype(np.int64, copy=False)
    return (whole[:, 0], whole[:, 1]) if whole.ndim == 2 else (whole, None)


def seeds_of(seed: int | list[int | None] | None, runs: int) -> list[int | None]:
    """Return a seed for each run, as Gymnasium's own vector envs give them out: of a number the next ones, or the list.

    ValueError if the list doesn't have one entry per run.
    """
    if seed is None:
        return [None] * runs
    if isinstance(seed, int):
        return [seed + run for run in range(runs)]
    if len(seed) != runs:
        raise ValueError(f"seed needs one entry for each of the {runs} runs")
    return list(seed)


def reset_options(options: dict[str, Any] | None, scenarios: Sequence[Scenario]) -> tuple[Bools, Int64s]:
    """Return the mask (R,) and the materials (R,) of a vector reset, including defaults.

    ValueError if an array doesn't have one entry per run, or a material's index doesn't exist; ScenarioError if no
    material has that name.
    """
    runs = len(scenarios)
    options = options or {}
    mask = np.asarray(options["reset_mask"] if "reset_mask" in options else np.ones(runs), dtype=np.bool_)
    materials = options.get("material")
    if materials is None:
        materials = [scenario.best_material for scenario in scenarios]
    elif isinstance(materials, str):
        materials = [scenario.material_index(materials) for scenario in scenarios]
    materials = np.asarray(materials, dtype=np.int64)
    if mask.shape != (runs,) or materials.shape != (runs,):
        raise ValueError(f"reset_mask and material need one entry for each of the {runs} runs")
    begun = mask.nonzero()[0].tolist()
    if any(not 0 <= materials[run] < len(scenarios[run].materials) for run in begun):
        raise ValueError("material: an index that the scenario doesn't have")
    return mask, materials


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
        """Do one action in every arena whose episode runs, and reset every other arena.

        Flags and rewards are this step's. ResetNeeded before the first reset; ValueError if there isn't one action for
        each arena.
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
