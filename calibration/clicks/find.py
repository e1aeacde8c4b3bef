"""Places to click in the game's menus: found by their labels on a walk through the menus, and by hand where that fails.

world -> Esc -> Game Menu -> the world again -> and, where it is safe and wanted, title -> list of worlds -> the world
"""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from calibration.bench import BenchOf
from calibration.clicks.by_hand import largest_scale, record
from calibration.clicks.menu_walk import MenuWalk
from calibration.clicks.shown import Point, dry_run, picture_of, picture_of_screen
from calibration.report.kept import keep_or_warn
from calibration.start import profile_to_calibrate
from calibration.step import Bench, Found, Picture
from calibration.written import write_found, write_picture
from mc_nested.errors import NotConfirmedError, ProfileError, UserError
from mc_nested.live.at_rest import wait_for_front
from mc_nested.live.click_points import ClickPoints
from mc_nested.live.desktop.hotkeys import open_hotkeys
from mc_nested.live.fingerprint import version_in
from mc_nested.live.font import load_font
from mc_nested.live.point_pictures import load_click_points
from mc_nested.live.profile import Profile
from mc_nested.live.way_back import RESPAWN

STEP = "clicks"

MENU_POINTS: Mapping[str, str] = {
    "back_to_game": "Back to Game, in the pause menu (Esc)",
    "save_and_quit_to_title": "Save and Quit to Title, in the pause menu",
    "singleplayer": "Singleplayer, on the title screen",
    "world": "the world to play in, on the Select World screen",
    "play_selected_world": "Play Selected World, on the Select World screen",
    "respawn": "Respawn, on the death screen",
}
"""The points that the menus have, and where they are found; in the order of a way through them from the world."""

QUESTION = (
    "To find the buttons of the title and of the list of worlds, the world is saved and left, and entered again. Do it?"
)

SWITCHED_S = 1.0
"""From the game's coming to the front until it shows what it will: it may open a menu only now."""

Listen = Callable[[Sequence[str]], AbstractContextManager[Callable[[], str]]]
"""Hears keys, whatever window is in front."""

ByHand = Callable[[Mapping[str, str]], Sequence[Point]]
"""Records points by hand: from their names and where they are found, those that were not skipped."""


def calibrate_clicks(
    profile_name: str | Path,
    bench_of: BenchOf,
    *,
    names: Sequence[str] = (),
    is_by_hand: bool = True,
    hotkey: str = "f8",
    skip: str = "f9",
    listen: Listen = open_hotkeys,
) -> tuple[Found, Path] | None:
    """Record a profile's points, and write them with a picture that shows them; both, or None if all were skipped.

    Args:
        profile_name: a name or a file; a new profile is made where there is none.
        bench_of: opens the window.
        names: what to record by hand; left out, the menus are gone through.
        is_by_hand: whether what is not found there is asked for by hand.
        hotkey: records the place that the mouse is over.
        skip: leaves a point as the profile has it.
        listen: hears the two keys.

    Raises:
        UserError: a profile, key or desktop that can't be used, or a picture that can't be written.
        LiveError: as ``find_clicks``.
    """
    if hotkey == skip:
        raise UserError(f"{hotkey} can't both record and skip: choose another key for one of them")
    path, profile = profile_to_calibrate(profile_name)
    if not names and profile.screen.font is None:
        raise ProfileError("labels are found with the game's font: run mc-nested calibrate font first")
    with bench_of(profile) as bench:

        def by_hand(wanted: Mapping[str, str]) -> Sequence[Point]:
            with listen((hotkey, skip)) as next_key:
                bench.say(f"In the game, hover over each place and press {hotkey}; {skip} skips one; Ctrl+C ends it.")
                display, pointer = bench.desktop.display, bench.desktop.pointer
                return record(wanted, display, pointer, next_key, skip=skip, say=bench.say)

        if names:
            points = by_hand({name: MENU_POINTS.get(name, name) for name in names})
            found = _found(profile, [], points, None)
        else:
            found = find_clicks(bench, profile, by_hand if is_by_hand else None)
        if not found.points:
            for line in found.lines:
                bench.say(line)
            return None
    write_found(found, path)
    keep_or_warn(bench.say, path, [found])
    picture = picture_file(path)
    write_picture(found.pictures[0].frame, picture)
    return found, picture


def find_clicks(bench: Bench, profile: Profile, by_hand: ByHand | None = None) -> Found:
    """The profile with the menus' points, found by their labels; the world is on the screen again afterwards.

    Another program's menus, by the window's title, are left alone: it may take the same keys for something else. The
    title and the list of worlds are visited only where the world is surely a single player's, and the person says
    yes. What is not found is asked for by hand, where ``by_hand`` can; the death screen is never gone to.

    Raises:
        ProfileError: the profile has no font.
        LiveError: the way through the menus, or back into the same world, was not found; the window changed its size;
            what the hands raise.
    """
    font = load_font(profile.screen.font_path())
    points, notes, scale = [], ["the menus: not gone through, since the window's title names no Minecraft"], None
    if version_in(bench.desktop.display.title()) is not None:
        walk = _walked(MenuWalk(bench, profile, font), bench)
        points, notes, scale = list(walk.points.values()), walk.notes, walk.scale
    names = {point.name for point in points} | {RESPAWN}
    missing = {name: where for name, where in MENU_POINTS.items() if name not in names}
    if missing and by_hand is not None:
        points += by_hand(missing)
    return _found(profile, notes, points, scale)


def find_some_clicks(bench: Bench, profile: Profile) -> Found:
    """As ``find_clicks``, with nobody there to record by hand; NotConfirmedError where nothing was found."""
    found = find_clicks(bench, profile)
    if not found.points:
        raise NotConfirmedError(f"{found.lines[0]}: record them by hand with mc-nested calibrate clicks")
    return found


def _walked(walk: MenuWalk, bench: Bench) -> MenuWalk:
    walk.through_pause()
    if not walk.is_single_player:
        walk.note("the title and the list of worlds: not visited, since this may not be a world of your own")
    elif bench.ask(QUESTION):
        walk.through_title()
    else:
        walk.note("the title and the list of worlds: not visited")
    return walk


def shown_clicks(profile_name: str | Path, bench_of: BenchOf) -> Path:
    """Write a picture of the game's screen with a profile's points marked on it; its file. Nothing is pressed."""
    path, profile, points = _points_of(profile_name)
    with bench_of(profile) as bench:
        _wait_for_menu(bench)
        drawn = picture_of_screen(points, bench.desktop.display.grab())
    picture = path.with_name(f"{path.stem}-clicks-now.png")
    write_picture(drawn, picture)
    return picture


def try_clicks(profile_name: str | Path, bench_of: BenchOf) -> list[str]:
    """Move the mouse to a profile's points that the game's screen shows, and press nothing; one line a point."""
    _, profile, points = _points_of(profile_name)
    with bench_of(profile) as bench:
        _wait_for_menu(bench)
        return dry_run(bench, points)


def picture_file(profile: Path) -> Path:
    """The file of the picture that shows a profile's points."""
    return profile.with_name(f"{profile.stem}-clicks.png")


def _points_of(profile_name: str | Path) -> tuple[Path, Profile, ClickPoints]:
    path, profile = profile_to_calibrate(profile_name)
    points = load_click_points(profile, path)
    if not points:
        raise ProfileError(f"{path}: has no points with pictures: run mc-nested calibrate clicks")
    return path, profile, points


def _wait_for_menu(bench: Bench) -> None:
    bench.say("Switch to the game, to the menu that is to be looked at.")
    wait_for_front(bench.desktop.display, bench.desktop.clock)
    bench.hands.wait(SWITCHED_S)


def _found(profile: Profile, notes: Sequence[str], points: Sequence[Point], scale: int | None) -> Found:
    """The profile with these points, at the GUI scale that was seen; one line, why there are none, where there are."""
    if not points:
        return Found(STEP, profile, ("; ".join(("no button was found", *notes[:1])),), 0)
    lines = [f"{point.name}: at {point.at[0]:.4f}, {point.at[1]:.4f} of the window" for point in points]
    if RESPAWN not in profile.points and all(point.name != RESPAWN for point in points):
        lines.append(f"{RESPAWN}: not seen, since nobody died: it is found by its label when that happens")
    recorded = []
    for point in points:
        height, width = point.frame.shape[:2]
        recorded.append(point.click_point(scale or largest_scale(width, height)))
    added = profile.model_copy(update={"points": profile.points | {point.name: point.at for point in points}})
    pictures = (Picture("Where menus are clicked", picture_of(points)),)
    return Found(STEP, added, (*lines, *notes), len(points), pictures, tuple(recorded))
