"""Arenas whose agents see the game's window: its last four pictures, small and grey, instead of (x, y, b).

A picture is taken when an action is confirmed. At a reset, four times the first one: the agent has seen no other yet.

It shows the world without debug screen, chat, hotbar and crosshair. Where the debug screen's boxes lie, the world
shines through and is worked out; its letters hide it, and so may the chat, the hotbar with what stands above it, and
the crosshair, whether they are there or not. A dot of the small picture is the mean of what isn't hidden of its part of
the window; black where nearly nothing is.
"""

from collections.abc import Sequence
from typing import Any

import cv2
import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv, taken_apart
from mc_nested.arrays import Bools, Float32s, Float64s, Int64s
from mc_nested.errors import LiveError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.chat_region import messages_region
from mc_nested.live.vision.debug_boxes import BRIGHTEST, ground_parts, has_letters, line_boxes
from mc_nested.live.vision.layout import BOX_ALPHA, BOX_GREY, Scales

SIDE = 84
"""Rows and columns of the small picture, as Mnih et al. (2015) took them of Atari's screens."""

_LEAST_SEEN = 0.1
"""The part of a dot's window pixels that has to be seen, or the dot is black."""

_CROSSHAIR = 18
"""GUI pixels of the crosshair's square, and of the axes that the debug screen shows in its place."""

_BAR_WIDTH, _BAR_HEIGHT = 184, 60
"""GUI pixels of the hotbar with the chosen slot's frame, and up to the name of what was taken in hand, over hearts and
food (FACTS: Screens and their buttons)."""

_OFF_HAND = 29
"""GUI pixels of a slot beside the hotbar."""


def world_greys(frame: Frame, scales: Scales) -> NDArray[np.uint8]:
    """Return the world on a picture of the whole window (height, width, 3) at these scales, as greys (84, 84)."""
    greys = cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY).astype(np.float32)
    seen = np.ones_like(greys)
    parts = ground_parts(frame, scales.debug)
    for box in () if parts else line_boxes(frame, scales.debug):
        _look_through(frame, greys, seen, box, scales.debug)
    for part in parts:
        _look_through(frame, greys, seen, part.region, scales.debug, part.grey)
    if parts:  # the bars beside the boxes
        seen[:, : scales.debug] = seen[:, -scales.debug :] = 0
    for region in hidden_regions((frame.shape[1], frame.shape[0]), scales.gui):
        seen[region.slices] = 0
    share = _smaller(seen)
    means = _smaller(greys * seen) / np.maximum(share, _LEAST_SEEN)
    return np.rint(np.where(share < _LEAST_SEEN, 0, means)).clip(0, 255).astype(np.uint8)


def hidden_regions(size: tuple[int, int], scale: int) -> tuple[Region, ...]:
    """Return what the chat's messages, the hotbar and the crosshair may hide in a window (width, height), in pixels."""
    width, height = size
    across, down = -(-width // scale) // 2, -(-height // scale)
    bar = (across - _BAR_WIDTH // 2 - _OFF_HAND, down - _BAR_HEIGHT, _BAR_WIDTH + 2 * _OFF_HAND, _BAR_HEIGHT)
    cross = (across - _CROSSHAIR // 2, down // 2 - _CROSSHAIR // 2, _CROSSHAIR, _CROSSHAIR)
    return (messages_region(size, scale), *(Region(*(max(0, part) * scale for part in each)) for each in (bar, cross)))


def _look_through(frame: Frame, greys: Float32s, seen: Float32s, box: Region, scale: int, grey: int = BOX_GREY) -> None:
    """Undo a box's grey. What its letters hide isn't seen, nor what an underline hides just below the box."""
    part, below = box.slices, Region(box.left, box.top + box.height, box.width, scale).slices
    # Where two boxes meet, what is left of the first one's world is not known.
    seen[part] *= (cv2.inRange(frame[part], (0, 0, 0), (BRIGHTEST,) * 3) > 0) & (greys[part] >= grey * BOX_ALPHA - 1)
    seen[below] *= ~has_letters(frame[below])
    greys[part] = np.maximum(0, (greys[part] - grey * BOX_ALPHA) / (1 - BOX_ALPHA))


def _smaller(picture: Float32s) -> Float32s:
    return np.asarray(cv2.resize(picture, (SIDE, SIDE), interpolation=cv2.INTER_AREA), np.float32)


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

    def cell(self, run: int) -> Cell:
        """Return where the agent stands in that arena."""
        return self._arenas.cell(run)

    def placed(self, run: int) -> frozenset[Cell]:
        """Return the cells where a block landed in that arena since its last reset."""
        return self._arenas.placed(run)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Pictures, dict[str, Any]]:
        """Begin an episode in the masked arenas, or in all.

        Raise LiveError if a game can't, or its window isn't seen.
        """
        _, info = self._arenas.reset(seed=seed, options=options)
        begun = np.asarray((options or {}).get("reset_mask", np.ones(self.num_envs)), np.bool_)
        for run in np.flatnonzero(begun).tolist():
            self._pictures[run] = seen_in(self._windows[run])
        self._has_ended &= ~begun
        return self._pictures.copy(), info

    def step(self, actions: Int64s) -> tuple[Pictures, Float64s, Bools, Bools, dict[str, Any]]:
        """Perform an action in every arena whose episode runs, and picture it; raise LiveError as for ``reset``."""
        acts = ~self._has_ended & (taken_apart(actions, len(self._has_ended))[0] != NO_ACTION)
        _, rewards, terminated, truncated, info = self._arenas.step(actions)
        for run in np.flatnonzero(acts).tolist():
            self._pictures[run, :-1] = self._pictures[run, 1:]
            self._pictures[run, -1] = seen_in(self._windows[run])
        self._has_ended = terminated | truncated
        return self._pictures.copy(), rewards, terminated, truncated, info


def windows_of(arenas: ArenaVectorEnv) -> Sequence[GameConnection]:
    """Return the connection of each arena's game; raise UserError if one isn't played in a window."""
    windows: list[Any] = [getattr(env.game, "connection", None) for env in arenas.envs]
    if None in windows:
        raise UserError(NEEDS_A_WINDOW)
    return windows


def seen_in(window: GameConnection) -> Pictures:
    """Return the world in a game's window now, (84, 84); raise LiveError if its GUI scale can't be seen."""
    scales = window.screen.seen_scales()
    if scales is None:
        raise LiveError("the debug screen isn't seen, and with it the GUI scale: press F3 in the game")
    return world_greys(window.devices.display.grab(), scales)
