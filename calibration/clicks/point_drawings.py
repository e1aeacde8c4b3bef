"""Drawings of click points: on the screens that they were recorded on, or on the current screen."""

from collections.abc import Sequence

import cv2
import numpy as np

from calibration.clicks.recorded_point import RecordedPoint
from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import ClickPoints, looks_the_same

TILE_WIDTH = 640
"""Width in pixels of each recorded screen in the drawing: enough to read a button's label."""

MARK_COLOUR, SEEN_COLOUR = (0, 0, 255), (0, 200, 0)
"""Red, and green for what looks like its picture, as blue green red."""

_TEXT_FONT = cv2.FONT_HERSHEY_SIMPLEX


def picture_of_points(points: Sequence[RecordedPoint]) -> Frame:
    """The recorded screens below each other, each with its point marked and labelled: (height, TILE_WIDTH, 3)."""
    return np.concatenate([_tile(point) for point in points])


def picture_of_screen(points: ClickPoints, frame: Frame) -> Frame:
    """One screen with all points marked, and below it their pictures: green if the two look the same, else red."""
    drawing: Frame = frame.copy()
    size = (int(frame.shape[1]), int(frame.shape[0]))
    rows = [drawing]
    for point in points.values():
        colour = SEEN_COLOUR if looks_the_same(point, frame) else MARK_COLOUR
        (x, y), (height, width) = point.position(size), point.picture.shape[:2]
        cv2.rectangle(drawing, (x - width // 2, y - height // 2), (x + width // 2, y + height // 2), colour, 1)
        cv2.drawMarker(drawing, (x, y), colour, cv2.MARKER_CROSS, 16, 1)
        row: Frame = np.full((max(height, 24) + 8, size[0], 3), 32, np.uint8)
        row[4 : 4 + height, 4 : 4 + width] = point.picture[:, : size[0] - 4]
        text = f"{point.name}: {'here' if colour == SEEN_COLOUR else 'not on this screen'}"
        cv2.putText(row, text, (width + 16, 22), _TEXT_FONT, 0.6, colour, 1, cv2.LINE_AA)
        rows.append(row)
    return np.concatenate(rows)


def _tile(point: RecordedPoint) -> Frame:
    height = max(1, round(point.frame.shape[0] * TILE_WIDTH / point.frame.shape[1]))
    tile = np.ascontiguousarray(cv2.resize(point.frame, (TILE_WIDTH, height), interpolation=cv2.INTER_AREA), np.uint8)
    x, y = int(point.at[0] * TILE_WIDTH), int(point.at[1] * height)
    cv2.drawMarker(tile, (x, y), MARK_COLOUR, cv2.MARKER_CROSS, 24, 1)
    cv2.circle(tile, (x, y), 12, MARK_COLOUR, 1)
    wide = int(cv2.getTextSize(point.name, _TEXT_FONT, 0.6, 1)[0][0])
    tile[:28, : wide + 16] = 0
    cv2.putText(tile, point.name, (8, 20), _TEXT_FONT, 0.6, (255, 255, 255), 1, cv2.LINE_AA)
    return tile
