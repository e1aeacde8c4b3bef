"""Places to click, shown to a person: marked on the screens they were recorded on, or on the one that is there now."""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from calibration.step import Bench
from mc_nested.live.click_points import ClickPoint, ClickPoints, hover_over, looks_the_same, recorded
from mc_nested.live.devices import Frame

TILE_WIDTH = 640
"""Pixels that each recorded screen takes on the picture: enough to read a button's label."""

MARK_COLOUR, SEEN_COLOUR = (0, 0, 255), (0, 200, 0)
"""Red, and green for what looks like its picture, as blue green red."""

_FACE = cv2.FONT_HERSHEY_SIMPLEX


SHOW_S = 0.7
"""How long the mouse stays on a point, so that a person can follow it."""


@dataclass(frozen=True)
class Point:
    """A recorded place: fractions of the window's width and height, and the screen that it was recorded on."""

    name: str
    at: tuple[float, float]
    frame: Frame

    def click_point(self, scale: int) -> ClickPoint:
        """The same as a place that can be clicked, at that GUI scale."""
        height, width = self.frame.shape[:2]
        place = min(round(self.at[0] * width), width - 1), min(round(self.at[1] * height), height - 1)
        return dataclasses.replace(recorded(self.name, self.frame, place, scale), at=self.at)


def picture_of(points: Sequence[Point]) -> Frame:
    """The recorded screens below each other, each with its point marked and named: (height, TILE_WIDTH, 3)."""
    return np.concatenate([_tile(point) for point in points])


def picture_of_screen(points: ClickPoints, frame: Frame) -> Frame:
    """One screen with all points marked, and below it their pictures: green where the two are alike, else red."""
    drawn: Frame = frame.copy()
    size = (int(frame.shape[1]), int(frame.shape[0]))
    rows = [drawn]
    for point in points.values():
        colour = SEEN_COLOUR if looks_the_same(point, frame) else MARK_COLOUR
        (x, y), (height, width) = point.place(size), point.picture.shape[:2]
        cv2.rectangle(drawn, (x - width // 2, y - height // 2), (x + width // 2, y + height // 2), colour, 1)
        cv2.drawMarker(drawn, (x, y), colour, cv2.MARKER_CROSS, 16, 1)
        row: Frame = np.full((max(height, 24) + 8, size[0], 3), 32, np.uint8)
        row[4 : 4 + height, 4 : 4 + width] = point.picture[:, : size[0] - 4]
        words = f"{point.name}: {'here' if colour == SEEN_COLOUR else 'not on this screen'}"
        cv2.putText(row, words, (width + 16, 22), _FACE, 0.6, colour, 1, cv2.LINE_AA)
        rows.append(row)
    return np.concatenate(rows)


def dry_run(bench: Bench, points: ClickPoints) -> list[str]:
    """Move the mouse to each point that is seen on the screen, and press nothing; one line for each point.

    Raises what the hands raise.
    """
    told = []
    for point in points.values():
        is_there = hover_over(point, bench.hands, bench.desktop.display)
        told.append(f"{point.name}: {'here, and the mouse over it' if is_there else 'not on this screen'}")
        if is_there:
            bench.hands.wait(SHOW_S)
    return told


def _tile(point: Point) -> Frame:
    height = max(1, round(point.frame.shape[0] * TILE_WIDTH / point.frame.shape[1]))
    tile = np.ascontiguousarray(cv2.resize(point.frame, (TILE_WIDTH, height), interpolation=cv2.INTER_AREA), np.uint8)
    x, y = int(point.at[0] * TILE_WIDTH), int(point.at[1] * height)
    cv2.drawMarker(tile, (x, y), MARK_COLOUR, cv2.MARKER_CROSS, 24, 1)
    cv2.circle(tile, (x, y), 12, MARK_COLOUR, 1)
    wide = int(cv2.getTextSize(point.name, _FACE, 0.6, 1)[0][0])
    tile[:28, : wide + 16] = 0
    cv2.putText(tile, point.name, (8, 20), _FACE, 0.6, (255, 255, 255), 1, cv2.LINE_AA)
    return tile
