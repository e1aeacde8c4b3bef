"""Places to click, recorded by hand: hover, press the hotkey. Kept as fractions of the window, shown on a picture."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from calibration.start import profile_to_calibrate
from mc_nested.errors import ProfileError, UserError
from mc_nested.live.desktop import Desktop, open_desktop
from mc_nested.live.desktop.hotkeys import open_hotkeys
from mc_nested.live.devices import Display, Frame, Pointer
from mc_nested.live.profile import save_profile

MENU_POINTS: Mapping[str, str] = {
    "back_to_game": "Back to Game, in the pause menu (Esc)",
    "save_and_quit_to_title": "Save and Quit to Title, in the pause menu",
    "singleplayer": "Singleplayer, on the title screen",
    "world": "the world to play in, on the Select World screen",
    "play_selected_world": "Play Selected World, on the Select World screen",
    "respawn": "Respawn, on the death screen",
}
"""The points that the menus have, and where they are found; in the order of a way through them from the world."""

TILE_WIDTH = 640
"""Pixels that each recorded screen takes on the picture: enough to read a button's label."""

MARK_COLOUR = (0, 0, 255)
"""Red, as blue green red."""


@dataclass(frozen=True)
class Point:
    """A recorded place: fractions of the window's width and height, and the screen that it was recorded on."""

    name: str
    at: tuple[float, float]
    frame: Frame


def calibrate_clicks(
    profile_name: str | Path,
    *,
    say: Callable[[str], None],
    names: Sequence[str] = (),
    hotkey: str = "f8",
    skip: str = "f9",
    open_devices: Callable[[str], AbstractContextManager[Desktop]] = open_desktop,
    listen: Callable[[Sequence[str]], AbstractContextManager[Callable[[], str]]] = open_hotkeys,
) -> tuple[Path, Path] | None:
    """Record points by hand into a profile; its file and the picture that shows them, or None if all were skipped.

    Args:
        profile_name: a name or a file; a new profile is made where there is none.
        say: tells the player what to do.
        names: what to record; left out, the menus' points.
        hotkey: records the place that the mouse is over.
        skip: leaves a point as the profile has it.
        open_devices: opens the window of a title.
        listen: hears keys, whatever window is in front.

    Raises:
        UserError: a profile, key or desktop that can't be used, or a picture that can't be written.
    """
    if hotkey == skip:
        raise UserError(f"{hotkey} can't both record and skip: choose another key for one of them")
    path, profile = profile_to_calibrate(profile_name)
    wanted = {name: MENU_POINTS.get(name, name) for name in names or MENU_POINTS}
    with open_devices(profile.window.title) as desktop, listen((hotkey, skip)) as next_key:
        say(f"In the game, hover over each place and press {hotkey}; {skip} skips one; Ctrl+C here ends it all.")
        points = record(wanted, desktop.display, desktop.pointer, next_key, skip=skip, say=say)
    if not points:
        return None
    picture = path.with_name(f"{path.stem}-clicks.png")
    save_profile(profile.model_copy(update={"points": profile.points | {each.name: each.at for each in points}}), path)
    _write(picture, picture_of(points))
    return path, picture


def record(
    wanted: Mapping[str, str],
    display: Display,
    pointer: Pointer,
    next_key: Callable[[], str],
    *,
    skip: str,
    say: Callable[[str], None],
) -> list[Point]:
    """The wanted points, each recorded at the next key; those skipped are left out.

    ``wanted`` has each point's name and where it is found; ``next_key`` waits for the hotkey or ``skip``.
    """
    points = []
    for name, where in wanted.items():
        say(f"{name}: {where}")
        point = None
        while point is None and next_key() != skip:
            point = _under_pointer(name, display, pointer, say)
        if point is not None:
            points.append(point)
    return points


def picture_of(points: Sequence[Point]) -> Frame:
    """The recorded screens below each other, each with its point marked and named: (height, TILE_WIDTH, 3)."""
    return np.concatenate([_tile(point) for point in points])


def _under_pointer(name: str, display: Display, pointer: Pointer, say: Callable[[str], None]) -> Point | None:
    if not display.is_in_front():
        say("another window is in front: click on the game, hover, and press the key again")
        return None
    (x, y), (width, height) = pointer.position(), display.size()
    if not (0 <= x < width and 0 <= y < height):
        say("the mouse is outside the game's window: hover over the place, and press the key again")
        return None
    return Point(name, (round(x / width, 4), round(y / height, 4)), display.grab())


def _tile(point: Point) -> Frame:
    height = max(1, round(point.frame.shape[0] * TILE_WIDTH / point.frame.shape[1]))
    tile = np.ascontiguousarray(cv2.resize(point.frame, (TILE_WIDTH, height), interpolation=cv2.INTER_AREA), np.uint8)
    x, y = int(point.at[0] * TILE_WIDTH), int(point.at[1] * height)
    cv2.drawMarker(tile, (x, y), MARK_COLOUR, cv2.MARKER_CROSS, 24, 1)
    cv2.circle(tile, (x, y), 8, MARK_COLOUR, 2)
    cv2.putText(tile, point.name, (8, 20), cv2.FONT_HERSHEY_SIMPLEX, 0.6, MARK_COLOUR, 2)
    return tile


def _write(path: Path, picture: Frame) -> None:
    try:
        path.write_bytes(cv2.imencode(".png", picture)[1].tobytes())
    except OSError as error:
        raise ProfileError(f"{path}: the picture can't be written ({error}); the points are in the profile") from error
