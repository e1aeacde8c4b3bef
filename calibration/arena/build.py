"""Build the arena where the player stands: survey, ask, copy what is there, build, and check what was built.

stand and look -> is it loaded, free, flat? -> the question -> a copy -> floor, border, gamerules, materials -> check
"""

import dataclasses
from collections.abc import Sequence
from pathlib import Path

from calibration.arena.ground_survey import BlockQueries, GroundSurvey, is_copy_gone, survey_ground, teleport_and_look
from calibration.arena.mark import arena_from_reading, load_profile_with_font
from calibration.arena.plan import box_at, build_commands, copy_command, do_overlap
from calibration.arena.undo import (
    read_copy_note,
    remove_saved_copy_note,
    undo_command,
    undo_hint_on_error,
    write_copy_note,
)
from calibration.command_console import CommandConsole
from calibration.context import CalibrationContext, OpenContext, ReportPicture, StepResult
from calibration.report.findings import save_findings_or_warn
from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.menus.reset import teleport_command
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.debug_entries import why_none_is_named
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import FLOOR, Arena, border_block, box_of, near_middle
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import without_chat
from mc_nested.live.vision.game_screen import seen_gui_scale

NO_COPY = "No copy can be kept here: this can't be undone."


def build_question(arena: Arena, ground: GroundSurvey, old: Arena | None, materials: Sequence[str]) -> str:
    """Return the question before anything is changed: what stands there, and what will be done."""
    low, high = arena.region
    stands = {True: "There is only air", False: "Something stands there", None: "What stands there is not known"}
    parts = [
        f"Build the arena from {low} to {high}, facing {arena.facing}? {stands[ground.is_free]}{_seen_in(ground)}."
    ]
    flat = {True: "is flat", False: "is not of one block", None: "may have holes, which is unknown here"}
    floor = "stays" if ground.keeps_floor else f"is replaced by {FLOOR}"
    parts.append(f"The floor, {ground.floor}, {flat[ground.is_flat]}: it {floor}.")
    parts.append(
        f"Every reset will remove all blocks of these two layers; around them comes a border of "
        f"{border_block(materials)}. Time, weather and mobs stand still, the game mode is creative, and the first "
        f"{len(materials)} slots of the hotbar are overwritten."
    )
    if ground.copy_to is not None:
        parts.append(f"What stands there is copied to {ground.copy_to} first, and --undo puts it back.")
    elif arena.copied_to is None:
        parts.append(NO_COPY)
    if old is not None and old.copied_to is not None and arena.copied_to is None:
        parts.append(f"The copy at {old.copied_to}, of what stood at the arena before this one, will be forgotten.")
    return " ".join(parts)


def undo_hint(arena: Arena) -> str:
    """Return the game's command that restores what stood there before."""
    if arena.copied_to is None:
        return "No copy was kept"
    box = box_of(arena)
    return f"What stood there comes back with {copy_command(box_at(box, arena.copied_to), box[0])}"


def build_summary(arena: Arena, ground: GroundSurvey, undo: str) -> list[str]:
    """Return what was built, one line each; ``undo`` is the command that puts back what stood there."""
    low, high = arena.region
    floor = f"the floor of {ground.floor} stayed" if ground.keeps_floor else f"the floor is {FLOOR}"
    lines = [f"Arena from {low} to {high}, facing {arena.facing}; {floor}, the border was seen on all four sides."]
    if arena.copied_to is not None:
        lines.append(f"What stood there is copied to {arena.copied_to}: {undo} puts it back.")
    else:
        lines.append("No copy was kept: this game can't copy blocks, or can't show that it did.")
    return lines


def _seen_in(ground: GroundSurvey) -> str:
    if ground.view is None:
        return ""
    blocks = [f"{name} at {block}" for block, name in list(ground.view.in_the_way.items())[:6]]
    looks = f"{ground.view.floor} of {ground.view.looks} looks saw the floor"
    far = [f"{ground.view.out_of_sight} more cells are out of sight"] if ground.view.out_of_sight else []
    return f" ({', '.join([*blocks, looks, *far])})"


def calibrate_built_arena(
    profile_name: str | Path,
    open_context: OpenContext,
    *,
    size: int = DEFAULT_SIZE,
    standing: Cell | None = None,
    font: Path | None = None,
    yes: bool = False,
) -> tuple[StepResult, Path]:
    """Build the arena as ``build_arena`` does, and write it into a profile. Returns the result and the profile's file.

    ``font`` is the client jar or font picture to read with, recorded in the profile; default: the profile's own.
    """
    path, profile = load_profile_with_font(
        profile_name, near_middle(size) if standing is None else standing, size, font
    )
    with undo_hint_on_error(path), open_context(profile) as context:
        result = build_arena(context, profile, path=path, size=size, standing=standing, yes=yes)
    with undo_hint_on_error(path):
        save_profile(result.profile, path)
    remove_saved_copy_note(result.profile, path)
    save_findings_or_warn(context.say, path, [result])
    return result, path


def build_arena(
    context: CalibrationContext,
    profile: Profile,
    *,
    path: Path | None = None,
    size: int = DEFAULT_SIZE,
    standing: Cell | None = None,
    yes: bool = False,
) -> StepResult:
    """Mark and build the arena around the player. The profile gets the arena, and the version in the window's title.

    Nothing is changed before the person has said yes (or, with ``yes``, without asking). If the game can copy blocks,
    what stood there is copied into the sky first, and ``arena.copied_to`` says where.

    Args:
        context: the devices and the person.
        profile: with the font.
        path: the profile's file. The copy is noted beside it before anything is built. A copy that was noted earlier
            and never undone is kept. Default: nothing is noted.
        size: cells along each side of the arena.
        standing: the cell that the player stands on; default: the middle of the near edge.
        yes: build without asking.

    Raises:
        DesktopError: others may share the game, and that is not allowed; nothing was pressed.
        UserError: no arena can be where the player stands, the debug screen names no block, the world has no commands,
            its blocks aren't loaded, or the answer was no.
        NotConfirmedError: what was built is not what is seen.
        NotInFrontError, UnreadableError: the game isn't in front, or its debug screen can't be read.
    """
    if profile.world is not None:
        raise UserError(
            "the profile's [world] has no commands: mark the arena only, with mc-nested calibrate arena --mark-only"
        )
    standing = near_middle(size) if standing is None else standing
    # What the shipped scenarios are built of, in the order of the hotbar.
    materials = [material.block for material in load_scenario("line").materials]
    connection = context.connection.for_profile(profile)
    display, screen = connection.devices.display, connection.screen
    context.say("Stand on the middle of the arena's near edge, and look across it and down at the ground.")
    context.say("Then leave mouse and keys alone.")
    reading = wait_until_standing_still(connection)
    connection.check_single_player()
    profile = profile.model_copy(update={"game": game_in(display.title(), profile.game)})
    if reason := why_none_is_named(reading, profile.game.version):
        raise UserError(reason)
    arena = arena_from_reading(reading, standing, size)
    console = CommandConsole(connection, profile)
    queries = BlockQueries(console, profile, screen, arena.yaw)
    ground = survey_ground(console, queries, profile, arena, standing)
    arena = arena.model_copy(update={"floor": ground.floor if ground.keeps_floor else FLOOR})
    before = ReportPicture("The ground of the arena, before", without_chat(display.grab(), seen_gui_scale(screen)))
    noted = read_copy_note(path) if path else None
    old = noted.arena if noted else profile.arena
    # The copy of what stood there before the first arena was built in the same box, if there is one.
    same = [each.arena for each in (noted, profile) if each and each.arena and box_of(each.arena) == box_of(arena)]
    first = next((each.copied_to for each in same if each.copied_to and not is_copy_gone(queries, each)), None)
    if first is not None:
        ground, arena = dataclasses.replace(ground, copy_to=None), arena.model_copy(update={"copied_to": first})
    elif path and noted and noted.arena and _overlaps_copied(queries, noted.arena, arena):
        raise UserError(
            "an arena of a calibration that ended early stands here: put back what stood there before, with "
            f"{undo_command(path)}, or stand where you stood then"
        )
    elif path and (known := profile.arena) and known.size != size and _overlaps_copied(queries, known, arena):
        raise UserError(
            f"an arena of another size, {known.size} x {known.size} cells, stands here: put back what stood there "
            f"before, with {undo_command(path)}, and calibrate again"
        )
    if not yes and not context.ask(build_question(arena, ground, old, materials)):
        raise UserError("the arena was not built: nothing was changed, in the world or in the profile")
    if ground.copy_to is not None:
        arena = _copied(console, queries, arena, ground.copy_to)
        hint = undo_hint(arena)
        if path:
            write_copy_note(profile.model_copy(update={"arena": arena}), path)
            hint = f"From now on it is put back by {undo_command(path)}"
        context.say(f"A copy of what stands there is at {ground.copy_to}. {hint}")
    for command in build_commands(profile, arena, materials, builds_floor=not ground.keeps_floor):
        console.send(command)
    looks = _check_built(console, profile, arena, materials, floor=ground.floor if ground.keeps_floor else FLOOR)
    console.send(teleport_command(arena, standing, profile.body.pitch))
    console.watch(lambda seen: seen.pitch is not None and abs(seen.pitch - profile.body.pitch) < 1, 1.0)
    after = ReportPicture("The arena", without_chat(display.grab(), seen_gui_scale(screen)))
    with_arena = profile.model_copy(update={"arena": arena})
    undo = undo_command(path) if path else "mc-nested calibrate arena --undo"
    return StepResult("arena", with_arena, tuple(build_summary(arena, ground, undo)), looks, (before, after))


def _overlaps_copied(queries: BlockQueries, old: Arena, arena: Arena) -> bool:
    """Return whether this arena overlaps an old one whose copy still exists."""
    return do_overlap(box_of(old), box_of(arena)) and not is_copy_gone(queries, old)


def _copied(console: CommandConsole, queries: BlockQueries, arena: Arena, to: Block) -> Arena:
    """Copy the arena's box; return the arena with that copy."""
    box = box_of(arena)
    console.send(copy_command(box, to))
    if not queries.are_alike(box, to):
        raise NotConfirmedError(f"the copy to {to} was not seen to be made: nothing else was changed, try again")
    return arena.model_copy(update={"copied_to": to})


def _check_built(
    console: CommandConsole, profile: Profile, arena: Arena, materials: Sequence[str], *, floor: str
) -> int:
    """Check that the floor in the arena's middle and each border are seen. Returns the number of looks."""
    pitch, prefix = profile.body.pitch, profile.blocks.shown_prefix
    middle, last = arena.middle, arena.size - 1
    x, y, z = arena.block_of((middle[0], middle[1] + 1))
    expected = [(middle, 0.0, (x, y - 1, z), floor)]
    # From the cell before the middle of each border: the way to it, and the turn to the right that faces it.
    for cell, (right, forward), turn in (
        ((middle[0], last), (0, 1), 0.0),
        ((last, middle[1]), (1, 0), 90.0),
        ((middle[0], 0), (0, -1), 180.0),
        ((0, middle[1]), (-1, 0), -90.0),
    ):
        block = arena.block_of((cell[0] + right, cell[1] + forward))
        expected.append((cell, turn, block, border_block(materials)))
    for cell, turn, block, name in expected:
        east, up, south = arena.centre_of(cell)
        yaw = (arena.yaw + turn + 180) % 360 - 180
        target = teleport_and_look(console, f"{east:.1f} {up:.0f} {south:.1f} {yaw:g} {pitch:g}", yaw, pitch)
        if target is None or target.pos != block or target.id != prefix + name:
            seen = f"{target.id} at {target.pos}" if target else "nothing"
            raise NotConfirmedError(
                f"{name} should be seen at {block}, the screen says {seen}: are cheats on, and is the version right "
                f"({profile.game.version})? {undo_hint(arena)}"
            )
    return len(expected)
