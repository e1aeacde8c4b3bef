"""Find the buttons of the game's menus by their labels on a walk through the menus, and by hand where that fails.

world -> Esc -> Game Menu -> the world again -> and, if it is safe and wanted, title -> list of worlds -> the world

By hand, the player hovers over each button and presses a hotkey.
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from calibration.clicks.menu_walk import MenuWalk
from calibration.clicks.points import RecordedPoint, picture_of_points
from calibration.context import CalibrationContext, OpenContext, ReportPicture, StepResult
from calibration.step_profile import keep_result, starting_profile
from mc_nested.errors import NotConfirmedError, ProfileError, UserError
from mc_nested.live.desktop.key_listener import open_hotkeys
from mc_nested.live.devices import SWITCH_KEYS, Display, Pointer
from mc_nested.live.menus.click_points import has_pattern
from mc_nested.live.menus.screens import RESPAWN
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.tables import Profile


def record_by_hand(
    wanted: Mapping[str, str],
    display: Display,
    pointer: Pointer,
    next_key: Callable[[], str],
    *,
    skip: str,
    say: Callable[[str], None],
) -> list[RecordedPoint]:
    """Record each wanted point at the next hotkey, and return them; skipped ones are left out.

    ``wanted`` maps each point's name to a description of where it is. ``next_key`` waits for the hotkey or ``skip``.
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


def _under_pointer(name: str, display: Display, pointer: Pointer, say: Callable[[str], None]) -> RecordedPoint | None:
    if not display.is_in_front():
        say(f"another window is in front: switch to the game with {SWITCH_KEYS}, hover, and press the key again")
        return None
    (x, y), frame = pointer.position(), display.grab()
    height, width = frame.shape[:2]
    if not (0 <= x < width and 0 <= y < height):
        say("the mouse is outside the game's window: hover over the button, and press the key again")
        return None
    point = RecordedPoint(name, (round(x / width, 4), round(y / height, 4)), frame)
    if not has_pattern(point.click_point(largest_scale(width, height)).picture):
        say("nothing is drawn there to recognize it by: hover over its label, and press the key again")
        return None
    return point


def largest_scale(width: int, height: int) -> int:
    """Return the GUI scale, up to 4, that the game picks by default in a window of that size."""
    return max(1, min(width // 320, height // 240, 4))


STEP = "clicks"

MENU_POINTS: Mapping[str, str] = {
    "back_to_game": "Back to Game, in the pause menu (Esc)",
    "save_and_quit_to_title": "Save and Quit to Title, in the pause menu",
    "singleplayer": "Singleplayer, on the title screen",
    "world": "the world to play in, on the Select World screen",
    "play_selected_world": "Play Selected World, on the Select World screen",
    "respawn": "Respawn, on the death screen",
}
"""The click points of the menus and where each is, in the order of a way through them from the world."""

QUESTION = (
    "To find the buttons of the title and of the list of worlds, the world is saved and left, and entered again. Do it?"
)

Listen = Callable[[Sequence[str]], AbstractContextManager[Callable[[], str]]]
"""Listens for keys, whatever window is in front."""

ByHand = Callable[[Mapping[str, str]], Sequence[RecordedPoint]]
"""Records points by hand, given their names and where they are; skipped ones are left out."""


def calibrate_clicks(
    profile_name: str | Path,
    open_context: OpenContext,
    *,
    names: Sequence[str] = (),
    is_by_hand: bool = True,
    hotkey: str = "f8",
    skip: str = "f9",
    listen: Listen = open_hotkeys,
) -> tuple[StepResult, Path] | None:
    """Record a profile's points, and write them with a picture that shows them; both, or None if all were skipped.

    Args:
        profile_name: a name or a file; a new profile is made if there is none.
        open_context: opens the window.
        names: the points to record by hand; default: walk through the menus.
        is_by_hand: whether points that are not found there are recorded by hand.
        hotkey: records the point under the mouse.
        skip: leaves a point as it is in the profile.
        listen: listens for the two keys.

    Raises:
        UserError: a profile, key or desktop that can't be used, or a picture that can't be written.
        LiveError: as ``find_clicks``.
    """
    if hotkey == skip:
        raise UserError(f"{hotkey} can't both record and skip: choose another key for one of them")
    path, profile = starting_profile(profile_name)
    if not names and profile.screen.font is None:
        raise ProfileError("labels are found with the game's font: run mc-nested calibrate font first")
    with open_context(profile) as context:

        def by_hand(wanted: Mapping[str, str]) -> Sequence[RecordedPoint]:
            with listen((hotkey, skip)) as next_key:
                context.say(f"In the game, hover over each point and press {hotkey}; {skip} skips one; Ctrl+C ends it.")
                display, pointer = context.devices.display, context.devices.pointer
                return record_by_hand(wanted, display, pointer, next_key, skip=skip, say=context.say)

        if names:
            points = by_hand({name: MENU_POINTS.get(name, name) for name in names})
            result = _result(profile, [], points, None)
        else:
            result = find_clicks(context, profile, by_hand if is_by_hand else None)
        if not result.points:
            for line in result.lines:
                context.say(line)
            return None
    return keep_result(result, path, picture_file(path), context.say)


def find_clicks(context: CalibrationContext, profile: Profile, by_hand: ByHand | None = None) -> StepResult:
    """Find the menus' points by their labels. Afterwards the world is on the screen again.

    The menus of another program, by the window's title, are left alone: its keys may do something else. The title
    and the list of worlds are visited only if this is surely a single player's world and the person says yes. Points
    that are not found are recorded by hand, if ``by_hand`` is given. The death screen is never visited.

    Raises:
        ProfileError: the profile has no font.
        LiveError: the way through the menus, or back into the same world, was not found; the window changed its size;
            errors of the input controller.
    """
    connection = context.connection.for_profile(profile)
    points, notes, scale = [], ["the menus: not gone through, since the window's title names no Minecraft"], None
    if version_in(context.devices.display.title()) is not None:
        walk = MenuWalk(connection, profile, context.say)
        walk.visit_pause_menu()
        left_out = "the title and the list of worlds: not visited"
        if not walk.is_single_player:
            walk.notes.append(f"{left_out}, since this may not be a world of your own")
        elif context.ask(QUESTION):
            walk.visit_title()
        else:
            walk.notes.append(left_out)
        points, notes, scale = list(walk.points.values()), walk.notes, walk.scale
    names = {point.name for point in points} | {RESPAWN}
    missing = {name: where for name, where in MENU_POINTS.items() if name not in names}
    if missing and by_hand is not None:
        points += by_hand(missing)
    return _result(profile, notes, points, scale)


def find_clicks_unattended(context: CalibrationContext, profile: Profile) -> StepResult:
    """Do as ``find_clicks``, without recording by hand. NotConfirmedError if nothing was found."""
    result = find_clicks(context, profile)
    if not result.points:
        raise NotConfirmedError(f"{result.lines[0]}: record them by hand with mc-nested calibrate clicks")
    return result


def picture_file(profile: Path) -> Path:
    """Return the file of the picture that shows a profile's points."""
    return profile.with_name(f"{profile.stem}-clicks.png")


def _result(profile: Profile, notes: Sequence[str], points: Sequence[RecordedPoint], scale: int | None) -> StepResult:
    """Return the profile with these points, recorded at that GUI scale. Without points, one line that says why."""
    if not points:
        return StepResult(STEP, profile, ("; ".join(("no button was found", *notes[:1])),), 0)
    lines = [f"{point.name}: at {point.at[0]:.4f}, {point.at[1]:.4f} of the window" for point in points]
    if RESPAWN not in profile.points and all(point.name != RESPAWN for point in points):
        lines.append(f"{RESPAWN}: not seen, since nobody died: it is found by its label when that happens")
    click_points = []
    for point in points:
        height, width = point.frame.shape[:2]
        click_points.append(point.click_point(scale or largest_scale(width, height)))
    with_points = profile.model_copy(update={"points": profile.points | {point.name: point.at for point in points}})
    pictures = (ReportPicture("Where menus are clicked", picture_of_points(points)),)
    return StepResult(STEP, with_points, (*lines, *notes), len(points), pictures, tuple(click_points))
