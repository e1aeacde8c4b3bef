"""Putting back what stood where an arena was built, from the copy in the sky."""

from pathlib import Path

from calibration.arena.copy_note import forget_copy, noted_copy
from calibration.arena.ground import is_copy_gone
from calibration.arena.plan import box_of, copy_command, fill_command, moved
from calibration.arena.questions import Questions
from calibration.arena.stand import NEAR_MIDDLE
from calibration.bench import BenchOf
from calibration.console import Console
from calibration.start import check_writable
from calibration.step import Bench, Found
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.commands import teleport_command
from mc_nested.live.fingerprint import check_single_player
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.profile import Profile, load_profile, profile_path, save_profile
from mc_nested.live.reading import Block
from mc_nested.live.session import overlay_of


def undo_built_arena(
    profile_name: str | Path, bench_of: BenchOf, *, is_server_allowed: bool = False
) -> tuple[Found, Path]:
    """Put back what stood where a profile's arena is, and write that; what was done, and the profile's file.

    An arena that was built by a calibration that ended early, so that only a note knows it, comes first.
    """
    path = profile_path(profile_name)
    noted = noted_copy(path)
    saved = load_profile(path) if path.is_file() or noted is None else None
    profile = noted or load_profile(path)
    _copy_of(profile)
    check_writable(path)
    with bench_of(profile) as bench:
        found = undo_arena(bench, profile, is_server_allowed=is_server_allowed)
    if saved is not None and saved.arena is not None and box_of(saved.arena) == box_of(profile.marked_arena()):
        save_profile(saved.model_copy(update={"arena": None}), path)
    forget_copy(path)
    return found, path


def undo_arena(bench: Bench, profile: Profile, *, is_server_allowed: bool = False) -> Found:
    """Put back what stood where the profile's arena is, and forget the arena.

    Raises:
        DesktopError: a game that others may share, unless ``is_server_allowed``; nothing was pressed.
        UserError: no copy is known.
        NotConfirmedError: the copy isn't where it was left, or was not seen put back; it is kept then.
    """
    arena, copied_to = profile.marked_arena(), _copy_of(profile)
    screen = WindowScreen(bench.desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    bench.say("Switch to the game: what stood where the arena is will be put back.")
    read_at_rest(bench.desktop.display, bench.desktop.clock, screen.read)
    check_single_player(bench.desktop.display.title(), is_server_allowed=is_server_allowed)
    console = Console(bench, profile, screen)
    questions = Questions(console, profile, screen, arena.yaw)
    box = box_of(arena)
    copy = moved(box, copied_to)
    console.send(teleport_command(arena, NEAR_MIDDLE, profile.body.pitch))
    if is_copy_gone(questions, arena):
        raise NotConfirmedError(f"no copy is at {copy[0]} any more, nothing was touched: is this the arena's world?")
    console.send(copy_command(copy, box[0]))
    if not questions.are_alike(copy, box[0]):
        raise NotConfirmedError(f"what is copied to {copy[0]} was not seen put back: nothing was removed, try again")
    console.send(fill_command(copy, "air"))
    line = f"What stood there is put back from {copy[0]}, and the copy is gone; time, weather, mobs and game mode stay."
    return Found("arena", profile.model_copy(update={"arena": None}), (line,), 1)


def _copy_of(profile: Profile) -> Block:
    copied_to = profile.marked_arena().copied_to
    if copied_to is None:
        raise UserError("no copy is known of what stood where the arena is: the profile has no arena.copied_to")
    return copied_to
