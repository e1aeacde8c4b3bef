"""The layers of a picture, from back to front: each covers a rectangle and can draw any part of it.

Positions are in framebuffer pixels, colours are red, green, blue. A layer never changes: to draw something else, make a
new layer. A window's picture is drawn when it is grabbed: only what changed, and only the grabbed part.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame, Region
from sim.client.game.widgets import Colour

Rect = tuple[int, int, int, int]
"""Left, top, right, bottom; the last two are outside."""


class Layer(Protocol):
    """A drawn rectangle."""

    @property
    def rect(self) -> Rect:
        """The rectangle it covers, perhaps beyond the window."""

    def draw(self, frame: Frame, part: Rect) -> None:
        """Draw the part of it in ``part``, a rectangle inside the frame and inside ``rect``."""


@dataclass(frozen=True, eq=False)
class Blend:
    """A colour over what is behind it; ``alpha`` is out of 255."""

    rect: Rect
    colour: Colour
    alpha: int

    def draw(self, frame: Frame, part: Rect) -> None:
        left, top, right, bottom = part
        under = frame[top:bottom, left:right]
        if self.alpha == 255:
            under[:] = self.colour[::-1]
        elif self.colour[0] == self.colour[1] == self.colour[2]:
            rest = (255 - self.alpha) / 255
            cv2.convertScaleAbs(under, under, rest, self.colour[0] * self.alpha / 255)
        else:
            over = np.array(self.colour[::-1], np.uint16) * self.alpha
            under[:] = (under.astype(np.uint16) * (255 - self.alpha) + over + 127) // 255


@dataclass(frozen=True, eq=False)
class Gradient:
    """A colour that changes from top to bottom, over what is behind it; each alpha is out of 255."""

    rect: Rect
    upper: tuple[Colour, int]
    lower: tuple[Colour, int]

    def draw(self, frame: Frame, part: Rect) -> None:
        left, top, right, bottom = part
        down = ((np.arange(top, bottom) - self.rect[1]) / max(1, self.rect[3] - self.rect[1]))[:, None, None]
        alpha = (self.upper[1] + (self.lower[1] - self.upper[1]) * down) / 255
        first, last = (np.array(colour[::-1], np.float32) for colour, _ in (self.upper, self.lower))
        over = first + (last - first) * down
        under = frame[top:bottom, left:right]
        under[:] = np.rint(under * (1 - alpha) + over * alpha)


@dataclass(frozen=True, eq=False)
class Ink:
    """The dots of a text, made when they are first drawn.

    ``dots`` returns two arrays: a mask (height, width) of 255 where there is a dot and 0 where the background shows,
    and the dots' colours (height, width, 3), blue green red.
    """

    rect: Rect
    dots: Callable[[], tuple[NDArray[np.uint8], NDArray[np.uint8]]]

    def draw(self, frame: Frame, part: Rect) -> None:
        left, top, right, bottom = part
        rows = slice(top - self.rect[1], bottom - self.rect[1])
        columns = slice(left - self.rect[0], right - self.rect[0])
        mask, colours = self.dots()
        cv2.copyTo(colours[rows, columns], mask[rows, columns], frame[top:bottom, left:right])


@dataclass(frozen=True, eq=False)
class Group:
    """Layers, at least one, that come and go together."""

    layers: Sequence[Layer]

    @cached_property
    def rect(self) -> Rect:
        lefts, tops, rights, bottoms = zip(*(layer.rect for layer in self.layers), strict=True)
        return min(lefts), min(tops), max(rights), max(bottoms)

    def draw(self, frame: Frame, part: Rect) -> None:
        draw_all(frame, self.layers, part)


def intersection(one: Rect, other: Rect) -> Rect | None:
    """Return the rectangle that two rectangles share, or None."""
    left, top = max(one[0], other[0]), max(one[1], other[1])
    right, bottom = min(one[2], other[2]), min(one[3], other[3])
    return (left, top, right, bottom) if left < right and top < bottom else None


def draw_all(frame: Frame, layers: Sequence[Layer], part: Rect) -> None:
    """Draw the part of all layers that lies in ``part``, later ones over earlier ones."""
    left, top, right, bottom = part
    for layer in layers:
        from_left, from_top, to_right, to_bottom = layer.rect
        # Most layers lie elsewhere; finding that out must not cost a call.
        if from_top < bottom and to_bottom > top and from_left < right and to_right > left:
            inside = max(left, from_left), max(top, from_top), min(right, to_right), min(bottom, to_bottom)
            layer.draw(frame, inside)


class LayeredPicture:
    """Layers over a background (height, width, 3), which is never written to.

    ``show`` sets what is shown; nothing is drawn before ``grab``.
    """

    def __init__(self, background: Frame) -> None:
        height, width = background.shape[:2]
        self._whole: Rect = (0, 0, width, height)
        self._frame = np.empty_like(background)
        self._background = background
        self._layers: Sequence[Layer] = ()
        self._stale: list[Rect] = [self._whole]
        self._grabbed: dict[Region | None, Frame] = {}

    def show(self, background: Frame, layers: Sequence[Layer]) -> None:
        """Show these layers over this background of the same size from now on."""
        self._grabbed.clear()
        if background is not self._background:
            self._stale = [self._whole]
        else:
            before, after = set(map(id, self._layers)), set(map(id, layers))
            changed = [layer for layer in self._layers if id(layer) not in after]
            changed += [layer for layer in layers if id(layer) not in before]
            for layer in changed:
                self._mark_stale(layer.rect)
        self._background, self._layers = background, layers

    def grab(self, region: Region | None = None) -> Frame:
        """Return the picture, or a region of it, cut off at the window's edges.

        It is read-only: where nothing has changed, the same array is returned again.
        """
        if region not in self._grabbed:
            frame = self._grabbed[region] = self._grab(region)
            frame.flags.writeable = False
        return self._grabbed[region]

    def _grab(self, region: Region | None) -> Frame:
        part = self._whole
        if region is not None:
            wanted = (region.left, region.top, region.left + region.width, region.top + region.height)
            part = intersection(wanted, self._whole) or (0, 0, 0, 0)
        kept = []
        for stale in self._stale:
            if inside := intersection(stale, part):
                left, top, right, bottom = inside
                self._frame[top:bottom, left:right] = self._background[top:bottom, left:right]
                draw_all(self._frame, self._layers, inside)
                kept += _around(stale, inside)
            else:
                kept.append(stale)
        self._stale = kept
        left, top, right, bottom = part
        return np.array(self._frame[top:bottom, left:right])

    def _mark_stale(self, rect: Rect) -> None:
        inside = intersection(rect, self._whole)
        if inside is None or any(_contains(stale, inside) for stale in self._stale):
            return
        self._stale = [stale for stale in self._stale if not _contains(inside, stale)]
        self._stale.append(inside)


def _around(rect: Rect, inside: Rect) -> list[Rect]:
    """Return what is left of a rectangle without one inside it."""
    left, top, right, bottom = rect
    from_left, from_top, to_right, to_bottom = inside
    around = [
        (left, top, right, from_top),
        (left, to_bottom, right, bottom),
        (left, from_top, from_left, to_bottom),
        (to_right, from_top, right, to_bottom),
    ]
    return [rect for rect in around if rect[0] < rect[2] and rect[1] < rect[3]]


def _contains(one: Rect, other: Rect) -> bool:
    return one[0] <= other[0] and one[1] <= other[1] and one[2] >= other[2] and one[3] >= other[3]
