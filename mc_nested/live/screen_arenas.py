"""Arenas whose agents see the game's window: its last four pictures, small and grey, instead of (x, y, b).

A picture is taken when an action is confirmed. At a reset, four times the first one: the agent has seen no other yet.
"""

from collections.abc import Sequence
from typing import Any, NoReturn

import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv, taken_apart
from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.errors import LiveError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.vision.world_greys import SIDE, world_greys

FRAMES = 4
"""Pictures in an observation, the newest last (Mnih et al., 2015)."""

NEEDS_A_WINDOW = (
    'states "screen" need a game\'s window, and the simulator has none: train with --backend virtual, or --backend live'
)
"""What to say where the states "screen" are asked for in the simulator."""

Pictures = NDArray[np.uint8]
"""(R, 4, 84, 84)."""


class ScreenArenas(VectorWrapper[Pictures, Int64s, Int64s, Int64s, Any]):
    """Arenas as their windows show them; rewards, flags and info are the arenas' own.

    Args:
        arenas: games that are played in windows, autoreset disabled.

    Raises:
        UserError: a game has no window.
    """

    resumable = None
    """A window's episode can't be saved half-way."""

    def __init__(self, arenas: ArenaVectorEnv) -> None:
        super().__init__(arenas)
        self._arenas = arenas
        self._windows = windows_of(arenas)
        self.single_observation_space = Box(0, 255, (FRAMES, SIDE, SIDE), np.uint8)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self._pictures: Pictures = np.zeros((self.num_envs, FRAMES, SIDE, SIDE), np.uint8)
        self._has_ended: Bools = np.zeros(self.num_envs, np.bool_)

    @property
    def scenario(self) -> Scenario:
        """What is built."""
        return self._arenas.scenario

    def cell(self, run: int) -> Cell:
        """Where the agent stands in that arena."""
        return self._arenas.cell(run)

    def placed(self, run: int) -> frozenset[Cell]:
        """The cells where a block landed in that arena since its last reset."""
        return self._arenas.placed(run)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Pictures, dict[str, Any]]:
        """Begin an episode in the masked arenas, or in all; LiveError if a game can't, or its window isn't seen."""
        _, info = self._arenas.reset(seed=seed, options=options)
        begun = np.asarray((options or {}).get("reset_mask", np.ones(self.num_envs)), np.bool_)
        for run in np.flatnonzero(begun).tolist():
            self._pictures[run] = seen_in(self._windows[run])
        self._has_ended &= ~begun
        return self._pictures.copy(), info

    def step(self, actions: Int64s) -> tuple[Pictures, Float64s, Bools, Bools, dict[str, Any]]:
        """One action in every arena whose episode runs, and a picture of it; LiveError as for ``reset``."""
        acts = ~self._has_ended & (taken_apart(actions, len(self._has_ended))[0] != NO_ACTION)
        _, rewards, terminated, truncated, info = self._arenas.step(actions)
        for run in np.flatnonzero(acts).tolist():
            self._pictures[run, :-1] = self._pictures[run, 1:]
            self._pictures[run, -1] = seen_in(self._windows[run])
        self._has_ended = terminated | truncated
        return self._pictures.copy(), rewards, terminated, truncated, info


def windows_of(arenas: ArenaVectorEnv) -> Sequence[GameConnection]:
    """The connection of each arena's game; UserError if one isn't played in a window."""
    return [getattr(env.game, "connection", None) or _has_no_window() for env in arenas.envs]


def seen_in(window: GameConnection) -> Pictures:
    """The world in a game's window now, (84, 84); LiveError if its GUI scale can't be seen."""
    scales = window.screen.seen_scales()
    if scales is None:
        raise LiveError("the debug screen isn't seen, and with it the GUI scale: press F3 in the game")
    return world_greys(window.devices.display.grab(), scales)


def _has_no_window() -> NoReturn:
    raise UserError(NEEDS_A_WINDOW)
