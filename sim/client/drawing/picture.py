"""A window's picture, drawn when it is grabbed: only what changed, and only the grabbed part."""

from collections.abc import Sequence

import numpy as np

from mc_nested.live.devices import Frame, Region
from sim.client.drawing.layers import Layer, Rect, draw_all, intersection


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
        """The picture, or a region of it, cut off at the window's edges.

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
                self._redraw(inside)
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

    def _redraw(self, part: Rect) -> None:
        left, top, right, bottom = part
        self._frame[top:bottom, left:right] = self._background[top:bottom, left:right]
        draw_all(self._frame, self._layers, part)


def _around(rect: Rect, inside: Rect) -> list[Rect]:
    """What is left of a rectangle without one inside it."""
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
