"""Undoes an arena: restores what stood there before from the copy in the sky."""

from pathlib import Path

from calibration.arena.block_queries import BlockQueries
from calibration.arena.copy_note import read_copy_note, remove_copy_note
from calibration.arena.ground_survey import is_copy_gone
from calibration.arena.plan import box_at, copy_command, fill_command
from calibration.command_console import CommandConsole
from calibration.context import CalibrationContext, StepResult
from calibration.open_context import OpenContext
from calibration.starting_profile import check_writable
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.devices import SWITCH_KEYS
from mc_nested.live.menus.commands import teleport_command
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.built_arena import box_of
from mc_nested.live.profile.store import load_profile, profile_path, save_profile
from mc_nested.live.profile.tables import Profile


def undo_built_arena(profile_name: str | Path, open_context: OpenContext) -> tuple[StepResult, Path]:
    """Undo a profile's arena and write the profile. Returns the result and the profile's file.

    An arena of an interrupted calibration, which only the note beside the profile knows, is undone first.
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
