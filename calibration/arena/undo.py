"""Undo an arena: restore what stood there before from the copy in the sky.

A note beside the profile says where that copy is while the profile doesn't: any interrupted build can be undone.

mine.toml           the profile, written once all steps are done
mine.toml.ground    the profile with the new arena, written before anything is built; removed once mine.toml has it
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from calibration.arena.ground_survey import BlockQueries, is_copy_gone
from calibration.arena.plan import box_at, copy_command
from calibration.command_console import CommandConsole
from calibration.context import CalibrationContext, OpenContext, StepResult
from calibration.step_profile import check_writable
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import McNestedError, NotConfirmedError, ProfileError, UserError
from mc_nested.live.devices import SWITCH_KEYS
from mc_nested.live.menus.reset import fill_command, teleport_command
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import box_of
from mc_nested.live.profile.store import load_profile, parse_profile, profile_path, save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.toml_file import read_toml_text


def note_path(profile: Path) -> Path:
    """Return the file of the note beside a profile's file."""
    return profile.with_name(f"{profile.name}.ground")


def read_copy_note(profile: Path) -> Profile | None:
    """Return the profile in the note, including its arena's copy; None without a note, ProfileError if it is broken."""
    file = note_path(profile)
    return parse_profile(read_toml_text(file, ProfileError), str(file)) if file.is_file() else None


def write_copy_note(known: Profile, profile: Path) -> None:
    """Write the note atomically, replacing an old one. ProfileError if the disk refuses."""
    file = note_path(profile)
    with refused_as(ProfileError, file, "nothing was built; make room, and try again"):
        file.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(file) as unfinished:
            unfinished.unlink(missing_ok=True)
            save_profile(known, unfinished)


def remove_copy_note(profile: Path) -> None:
    """Remove the note, if there is one. ProfileError if that fails."""
    try:
        note_path(profile).unlink(missing_ok=True)
    except OSError as error:
        raise ProfileError(f"{note_path(profile)}: can't be removed ({error}): remove it by hand") from error


def remove_saved_copy_note(saved: Profile, profile: Path) -> None:
    """Remove the note if the saved profile has the same arena."""
    noted = read_copy_note(profile)
    if noted is not None and noted.arena == saved.arena:
        remove_copy_note(profile)


def undo_command(profile: Path) -> str:
    """Return the shell command that undoes the arena."""
    name = profile.stem if profile == profile_path(profile.stem) else str(profile)
    quoted = f'"{name}"' if " " in name else name
    return f"mc-nested calibrate arena --undo --profile {quoted}"


@contextmanager
def undo_hint_on_error(profile: Path) -> Iterator[None]:
    """Add to the error's message how to undo the arena, if the block fails and a note is there."""
    try:
        yield
    except McNestedError as error:
        if not note_path(profile).is_file():
            raise
        raise type(error)(f"{error}; what stood where the arena is comes back with {undo_command(profile)}") from error


def undo_built_arena(profile_name: str | Path, open_context: OpenContext) -> tuple[StepResult, Path]:
    """Undo a profile's arena and write the profile. Returns the result and the profile's file.

    If a calibration was interrupted, only the note beside the profile knows its arena: that one is undone first.
    """
    path = profile_path(profile_name)
    noted = read_copy_note(path)
    saved = load_profile(path) if path.is_file() or noted is None else None
    profile = noted or load_profile(path)
    _copy_of(profile)
    check_writable(path)
    with open_context(profile) as context:
        result = undo_arena(context, profile)
    if saved is not None and saved.arena is not None and box_of(saved.arena) == box_of(profile.marked_arena()):
        save_profile(saved.model_copy(update={"arena": None}), path)
    remove_copy_note(path)
    return result, path


def undo_arena(context: CalibrationContext, profile: Profile) -> StepResult:
    """Restore what stood where the profile's arena is, and remove the arena from the profile.

    Raises:
        DesktopError: others may share the game, and that is not allowed; nothing was pressed.
        UserError: no copy is known.
        NotConfirmedError: the copy isn't there, or wasn't seen to be restored; then the copy stays.
    """
    arena, copied_to = profile.marked_arena(), _copy_of(profile)
    connection = context.connection.for_profile(profile)
    context.say(f"Switch to the game with {SWITCH_KEYS}: what stood where the arena is will be put back.")
    wait_until_standing_still(connection)
    connection.check_single_player()
    console = CommandConsole(connection, profile)
    queries = BlockQueries(console, profile, connection.screen, arena.yaw)
    box = box_of(arena)
    copy = box_at(box, copied_to)
    console.send(teleport_command(arena, arena.near_middle, profile.body.pitch))
    if is_copy_gone(queries, arena):
        raise NotConfirmedError(f"no copy is at {copy[0]} any more, nothing was touched: is this the arena's world?")
    console.send(copy_command(copy, box[0]))
    if not queries.are_alike(copy, box[0]):
        raise NotConfirmedError(f"what is copied to {copy[0]} was not seen put back: nothing was removed, try again")
    console.send(fill_command(copy, "air"))
    line = f"What stood there is put back from {copy[0]}, and the copy is gone; time, weather, mobs and game mode stay."
    return StepResult("arena", profile.model_copy(update={"arena": None}), (line,), 1)


def _copy_of(profile: Profile) -> Block:
    copied_to = profile.marked_arena().copied_to
    if copied_to is None:
        raise UserError("no copy is known of what stood where the arena is: the profile has no arena.copied_to")
    return copied_to
