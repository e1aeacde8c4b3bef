"""What a window shows of the world, small and grey: without debug screen, chat, hotbar and crosshair.

Where the debug screen's boxes lie, the world shines through and is worked out; its letters hide it, and so may the
chat, the hotbar with what stands above it, and the crosshair, whether they are there or not. A dot of the small picture
is the mean of what isn't hidden of its part of the window; black where nearly nothing is.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.scales import Scales
from mc_nested.live.vision.chat_region import messages_region
from mc_nested.live.vision.debug_boxes import ALPHA, BRIGHTEST, GREY, ink_of, line_boxes
from mc_nested.live.vision.group_boxes import ground_parts

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

Floats = NDArray[np.float32]


def world_greys(frame: Frame, scales: Scales) -> NDArray[np.uint8]:
    """The world on a picture of the whole window (height, width, 3) at these scales, as greys (84, 84)."""
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
        seen[_part(region)] = 0
    share = _smaller(seen)
    means = _smaller(greys * seen) / np.maximum(share, _LEAST_SEEN)
    return np.rint(np.where(share < _LEAST_SEEN, 0, means)).clip(0, 255).astype(np.uint8)


def hidden_regions(size: tuple[int, int], scale: int) -> tuple[Region, ...]:
    """What the chat's messages, the hotbar and the crosshair may hide of a window (width, height), in its pixels."""
    width, height = size
    across, down = -(-width // scale) // 2, -(-height // scale)
    bar = (across - _BAR_WIDTH // 2 - _OFF_HAND, down - _BAR_HEIGHT, _BAR_WIDTH + 2 * _OFF_HAND, _BAR_HEIGHT)
    cross = (across - _CROSSHAIR // 2, down // 2 - _CROSSHAIR // 2, _CROSSHAIR, _CROSSHAIR)
    return (messages_region(size, scale), *(Region(*(max(0, part) * scale for part in each)) for each in (bar, cross)))


def _look_through(frame: Frame, greys: Floats, seen: Floats, box: Region, scale: int, grey: int = GREY) -> None:
    """Undo a box's grey; what its letters hide isn't seen, nor what a line under them does, just below the box."""
    part, below = _part(box), _part(Region(box.left, box.top + box.height, box.width, scale))
    # Where two boxes meet, what is left of the first one's world is not known.
    seen[part] *= (cv2.inRange(frame[part], (0, 0, 0), (BRIGHTEST,) * 3) > 0) & (greys[part] >= grey * ALPHA - 1)
    seen[below] *= ~ink_of(frame[below])
    greys[part] = np.maximum(0, (greys[part] - grey * ALPHA) / (1 - ALPHA))


def _part(region: Region) -> tuple[slice, slice]:
    return slice(region.top, region.top + region.height), slice(region.left, region.left + region.width)


def _smaller(picture: Floats) -> Floats:
    return np.asarray(cv2.resize(picture, (SIDE, SIDE), interpolation=cv2.INTER_AREA), np.float32)
