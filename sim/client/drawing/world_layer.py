"""The world that the player sees, as the hindmost layer: sky, floor, blocks, the one looked at, the one in the hand.

Only the bands of rows that are asked for are drawn, so that reading lines of text doesn't draw all of it. Blocks are
drawn the farthest first. A block can hide another one only if that is no nearer along any axis, counted in blocks from
the eye's block.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Block
from sim.client.drawing import world_shapes
from sim.client.drawing.block_faces import Faces, both, brightness, cube_faces, faces_of, floor_faces, inside_rims
from sim.client.drawing.layers import Rect
from sim.client.drawing.world_shapes import (
    FACES,
    FAR,
    FIELD_OF_VIEW_DEG,
    NEAR,
    Matrix,
    block_colour,
    held_block,
    projection,
    view,
)
from sim.client.game.view import Eye, Sight
from sim.client.game.world import block_of

Points = NDArray[np.float64]

_FRACTION_BITS = 4
"""Bits for a corner's place within its pixel."""

_BLACK = (0, 0, 0)

BAND = 48
"""Rows that are drawn at once. OpenCV fills a polygon a little differently where it is cut off. So it is always cut off
at the same rows, whatever part of the picture is asked for."""


@dataclass(frozen=True)
class _Polygons:
    """Filled polygons, n of them, or outlines alone.

    Corners (n of (k, 2)) are in pixels, colours (n, 3) blue green red; ``rects`` (n, 4) hold the polygons.
    """

    corners: Sequence[Points]
    colours: Sequence[Sequence[int]]
    rects: NDArray[np.float64]
    are_outlines: bool = False

    def draw(self, frame: Frame, part: Rect) -> None:
        """Draw what of them lies in ``part`` of a window, whose picture ``frame`` is."""
        left, top, right, bottom = part
        rects = self.rects
        inside = (rects[:, 0] < right) & (rects[:, 1] < bottom) & (rects[:, 2] > left) & (rects[:, 3] > top)
        for index in np.flatnonzero(inside).tolist():
            fixed = np.rint((self.corners[index] - (left + 0.5, top + 0.5)) * 2**_FRACTION_BITS).astype(np.int32)
            if self.are_outlines:
                cv2.polylines(frame, [fixed], True, self.colours[index], shift=_FRACTION_BITS)
            else:
                cv2.fillConvexPoly(frame, fixed, self.colours[index], shift=_FRACTION_BITS)


@dataclass(frozen=True)
class _SeenFaces:
    """Faces as a camera sees them: the corners (n, 4, 4) of each, and of what lies within its rim; colours (n, 3)."""

    corners: Points
    inside: Points
    colours: Points

    def chosen(self, which: NDArray[np.bool_]) -> "_SeenFaces":
        return _SeenFaces(self.corners[which], self.inside[which], self.colours[which])


class WorldLayer:
    """The player's sight of the world in a window of ``size`` pixels, width and height."""

    def __init__(self, sight: Sight, size: tuple[int, int], faces: Faces) -> None:
        self._sight, self._size, self._all_faces = sight, size, faces
        self._bands: dict[int, Frame] = {}
        self.rect: Rect = (0, 0, *size)

    def draw(self, frame: Frame, part: Rect) -> None:
        left, top, right, bottom = part
        for first in range(top - top % BAND, bottom, BAND):
            upper, lower = max(top, first), min(bottom, first + BAND)
            frame[upper:lower, left:right] = self._band(first)[upper - first : lower - first, left:right]

    def _band(self, top: int) -> Frame:
        """Return BAND rows from ``top`` on, each drawn once."""
        if top not in self._bands:
            width, height = self._size
            bottom = min(height, top + BAND)
            band: Frame = np.asarray(cv2.repeat(self._rows[top:bottom, np.newaxis], 1, width), np.uint8)
            for polygons in self._polygons:
                polygons.draw(band, (0, top, width, bottom))
            self._bands[top] = band
        return self._bands[top]

    @cached_property
    def _rows(self) -> NDArray[np.uint8]:
        """The bare world's colour in each row of pixels (height, 3): the view never leans to a side."""
        eye, height = self._sight.eye, self._size[1]
        up = (1 - (2 * np.arange(height) + 1) / height) * math.tan(math.radians(FIELD_OF_VIEW_DEG) / 2)
        tilt = math.radians(eye.pitch)
        rises = up * math.cos(tilt) - math.sin(tilt)
        falls = np.where(rises < 0, -rises, 1e-9)
        away = (eye.position[1] - self._sight.floor) / falls
        fog = np.clip((away / FAR - world_shapes.FOG_FROM) / (1 - world_shapes.FOG_FROM), 0, 1)[:, np.newaxis]
        floor = np.array(block_colour(self._sight.floor_block)) * brightness()[0]
        rows = floor * (1 - fog) + np.array(world_shapes.SKY) * 255 * fog
        return np.rint(rows[:, ::-1]).astype(np.uint8)

    @cached_property
    def _polygons(self) -> list[_Polygons]:
        """All that stands on the bare world, in drawing order."""
        sight, origin = self._sight, block_of(self._sight.eye.position)
        faces = _in_drawing_order(_facing(self._all_faces, sight.eye, origin), origin)
        x, y, z = (part - own for part, own in zip(sight.eye.position, origin, strict=True))
        perspective = projection(*self._size)
        camera = perspective @ view((x, y, z), sight.eye.yaw, sight.eye.pitch)
        drawn = [_rimmed(_seen_by(camera, faces, origin), self._size)]
        if sight.target is not None:
            target = faces.chosen((faces.blocks == sight.target).all(1))
            drawn.append(_outlined(_seen_by(camera, target, origin), self._size))
        if sight.held is not None:
            cube = _seen_by(perspective @ held_block(), cube_faces(block_colour(sight.held)), (0, 0, 0))
            drawn.append(_rimmed(cube.chosen(_shows_its_front(cube.corners)), self._size))
        return drawn


class WorldLayers:
    """The worlds' layers of one window; where nothing has moved or changed, the same layer again."""

    def __init__(self, size: tuple[int, int]) -> None:
        self._size = size
        self._last: tuple[Sight, WorldLayer] | None = None
        self._built: object = None
        self._faces = cube_faces(_BLACK)
        self._floors: dict[Block, Faces] = {}

    def of(self, sight: Sight) -> WorldLayer:
        """Return the layer that shows it."""
        if self._last is None or sight != self._last[0]:
            self._last = sight, WorldLayer(sight, self._size, self._faces_of(sight))
        return self._last[1]

    def _faces_of(self, sight: Sight) -> Faces:
        if sight.built is not self._built:
            self._built, self._faces = sight.built, faces_of(sight.built, sight.floor)
            self._floors.clear()
        x, _, z = block_of(sight.eye.position)
        around = x, sight.floor, z
        if around not in self._floors:
            self._floors[around] = both(self._faces, floor_faces(around, sight.built, sight.floor, sight.floor_block))
        return self._floors[around]


def _facing(faces: Faces, eye: Eye, origin: Block) -> Faces:
    """Return the faces within sight whose outer side the eye is on."""
    axes = np.array([axis for (_, _, axis), _ in FACES])[faces.sides]
    outward = np.array([1 if side else -1 for _, side in FACES])[faces.sides]
    plane = faces.corners[np.arange(len(axes)), 0, axes]
    is_outside = (np.array(eye.position)[axes] - plane) * outward > 0
    return faces.chosen(is_outside & (np.abs(faces.blocks - origin).max(1, initial=0) <= FAR))


def _in_drawing_order(faces: Faces, origin: Block) -> Faces:
    away = np.abs(faces.blocks - origin).sum(1)
    order = np.argsort(-away, kind="stable")
    return Faces(faces.blocks[order], faces.sides[order], faces.corners[order], faces.colours[order])


def _seen_by(camera: Matrix, faces: Faces, origin: Block) -> _SeenFaces:
    """Return the faces as the camera sees them, without those beside the picture or behind it."""
    at = faces.corners - origin
    seen = _through(camera, at)
    may_be_seen = _may_be_seen(seen)
    return _SeenFaces(seen[may_be_seen], _through(camera, inside_rims(at[may_be_seen])), faces.colours[may_be_seen])


def _through(camera: Matrix, corners: Points) -> Points:
    """Return corners (n, 4, 3) as the camera sees them, (n, 4, 4)."""
    return np.asarray(corners @ camera[:, :3].T.astype(np.float64) + camera[:, 3], np.float64)


def _may_be_seen(seen: Points) -> NDArray[np.bool_]:
    """Return which squares (n,) may be seen: those not wholly beyond one side of the picture, nor behind the camera."""
    x, y, ahead = seen[..., 0], seen[..., 1], seen[..., 3]
    sides = (x < -ahead, x > ahead, y < -ahead, y > ahead, ahead < NEAR)
    return np.asarray(~np.any([side.all(-1) for side in sides], axis=0))


def _shows_its_front(seen: Points) -> NDArray[np.bool_]:
    """Return which squares (n,), all in front, are seen from their outer side: their corners run counter-clockwise."""
    x, y = seen[..., 0] / seen[..., 3], seen[..., 1] / seen[..., 3]
    return np.asarray((x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(1) > 0)


def _rimmed(faces: _SeenFaces, size: tuple[int, int]) -> _Polygons:
    """Return each face twice: all of it in its rim's brightness, and over it what lies within the rim."""
    count = len(faces.corners)
    corners = np.stack([faces.corners, faces.inside], axis=1).reshape(2 * count, 4, 4)
    inside, rim = brightness()
    colours = (faces.colours[:, np.newaxis, ::-1] * np.array([[rim], [inside]])).reshape(2 * count, 3)
    return _polygons(corners, np.rint(colours).astype(int).tolist(), size)


def _outlined(faces: _SeenFaces, size: tuple[int, int]) -> _Polygons:
    polygons = _polygons(faces.corners, [_BLACK] * len(faces.corners), size)
    return replace(polygons, are_outlines=True)


def _polygons(seen: Points, colours: Sequence[Sequence[int]], size: tuple[int, int]) -> _Polygons:
    """Return, in pixels, the parts of squares (n, 4, 4) that lie in front."""
    is_whole: NDArray[np.bool_] = np.all(seen[..., 3] >= NEAR, axis=-1)
    pixels = _pixels(np.where(is_whole[:, np.newaxis, np.newaxis], seen, 1.0), size)
    corners: list[Points] = list(pixels)
    rects = np.concatenate([np.floor(pixels.min(1)) - 1, np.ceil(pixels.max(1)) + 1], axis=1)
    for index in np.flatnonzero(~is_whole).tolist():
        corners[index] = _pixels(_in_front(seen[index]), size)
        rects[index] = 0, 0, *size
    return _Polygons(corners, colours, rects)


def _pixels(seen: Points, size: tuple[int, int]) -> Points:
    return np.asarray((seen[..., :2] / seen[..., 3:] * (1, -1) + 1) / 2 * size, np.float64)


def _in_front(seen: Points) -> Points:
    """Return the part of a polygon (n, 4) that isn't nearer than NEAR."""
    kept = []
    for one, other in zip(seen, np.roll(seen, -1, axis=0), strict=True):
        if one[3] >= NEAR:
            kept.append(one)
        if (one[3] >= NEAR) != (other[3] >= NEAR):
            kept.append(one + (other - one) * (NEAR - one[3]) / (other[3] - one[3]))
    return np.array(kept)
