"""A click point as it was recorded, with its whole screen; drawings of such points; and showing them to the player.

They are shown in a picture of the game's screen, or by moving the mouse to them.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from calibration.context import CalibrationContext, OpenContext
from calibration.step_profile import starting_profile, write_picture
from mc_nested.errors import ProfileError
from mc_nested.live.devices import SWITCH_KEYS, Frame
from mc_nested.live.menus.click_points import (
    ClickPoint,
    ClickPoints,
    hover_over,
    load_click_points,
    looks_the_same,
    record_point,
)
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.profile.tables import Profile


@dataclass(frozen=True)
class RecordedPoint:
    """A recorded click point: fractions of the window's width and height, and the screen that it was recorded on."""

    name: str
    at: tuple[float, float]
    frame: Frame

    def click_point(self, scale: int) -> ClickPoint:
        """Return the point as a ClickPoint, at that GUI scale."""
        height, width = self.frame.shape[:2]
        pixel = min(round(self.at[0] * width), width - 1), min(round(self.at[1] * height), height - 1)
        return dataclasses.replace(record_point(self.name, self.frame, pixel, scale), at=self.at)


TILE_WIDTH = 640
"""Width in pixels of each recorded screen in the drawing: enough to read a button's label."""

MARK_COLOUR, SEEN_COLOUR = (0, 0, 255), (0, 200, 0)
"""Red, and green for what looks like its picture, as blue green red."""

_TEXT_FONT = cv2.FONT_HERSHEY_SIMPLEX


def picture_of_points(points: Sequence[RecordedPoint]) -> Frame:
    """Draw the recorded screens below each other, each with its point marked and labelled: (height, TILE_WIDTH, 3)."""
    return np.concatenate([_tile(point) for point in points])


def picture_of_screen(points: ClickPoints, frame: Frame) -> Frame:
    """Draw a screen with all points marked and their pictures below: green if the two look the same, else red."""
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


SETTLE_S = 1.0
"""From the game coming to the front until its screen is stable: it may open a menu only now."""

HOVER_S = 0.7
"""How long the mouse stays on a point, so that a person can follow it."""


def show_clicks(profile_name: str | Path, open_context: OpenContext) -> Path:
    """Write a picture of the game's screen with a profile's points marked; returns its file. Nothing is pressed."""
    path, profile, points = _points_of(profile_name)
    with open_context(profile) as context:
        _wait_for_menu(context)
        drawing = picture_of_screen(points, context.devices.display.grab())
    picture = path.with_name(f"{path.stem}-clicks-now.png")
    write_picture(drawing, picture)
    return picture


def try_clicks(profile_name: str | Path, open_context: OpenContext) -> list[str]:
    """Move the mouse to each of a profile's points that the screen shows, and press nothing; one line per point."""
    _, profile, points = _points_of(profile_name)
    with open_context(profile) as context:
        _wait_for_menu(context)
        return dry_run(context, points)


def dry_run(context: CalibrationContext, points: ClickPoints) -> list[str]:
    """Move the mouse to each point that is seen on the screen, and press nothing; one line per point.

    Raises errors of the input controller.
    """
    lines = []
    for point in points.values():
        is_there = hover_over(point, context.controller, context.devices.display)
        lines.append(f"{point.name}: {'here, and the mouse over it' if is_there else 'not on this screen'}")
        if is_there:
            context.controller.wait(HOVER_S)
    return lines


def _points_of(profile_name: str | Path) -> tuple[Path, Profile, ClickPoints]:
    path, profile = starting_profile(profile_name)
    points = load_click_points(profile, path)
    if not points:
        raise ProfileError(f"{path}: has no points with pictures: run mc-nested calibrate clicks")
    return path, profile, points


def _wait_for_menu(context: CalibrationContext) -> None:
    context.say(f"Switch to the game with {SWITCH_KEYS}, to the menu that is to be looked at.")
    wait_for_front(context.devices)
    context.controller.wait(SETTLE_S)
