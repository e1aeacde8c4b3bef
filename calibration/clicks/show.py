"""Shows a profile's click points to the player: in a picture of the game's screen, or by moving the mouse to them."""

from pathlib import Path

from calibration.clicks.point_drawings import picture_of_screen
from calibration.context import CalibrationContext
from calibration.open_context import OpenContext
from calibration.starting_profile import starting_profile
from calibration.write_result import write_picture
from mc_nested.errors import ProfileError
from mc_nested.live.devices import SWITCH_KEYS
from mc_nested.live.menus.click_points import ClickPoints, hover_over
from mc_nested.live.menus.point_pictures import load_click_points
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.profile.tables import Profile

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
