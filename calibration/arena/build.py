"""Building the arena where the player stands: looked at first, asked about, copied, built, and looked at again.

stand and look -> is it loaded, free, flat? -> the question -> a copy -> floor, border, rules, materials -> seen
"""

import dataclasses
from collections.abc import Sequence
from pathlib import Path

from calibration.arena.copy_note import (
    forget_known_copy,
    note_copy,
    noted_copy,
    saying_how_to_undo,
    undo_command,
)
from calibration.arena.ground import is_copy_gone, looked_over
from calibration.arena.plan import (
    FLOOR,
    border_block,
    box_of,
    build_commands,
    copy_command,
    do_meet,
)
from calibration.arena.questions import Questions
from calibration.arena.sight import turned
from calibration.arena.stand import NEAR_MIDDLE, arena_seen, begun
from calibration.arena.words import how_to_undo, lines, question
from calibration.bench import BenchOf
from calibration.console import Console
from calibration.report.chat_region import without_chat
from calibration.report.kept import keep_or_warn
from calibration.step import Bench, Found, Picture
from mc_nested.arena.rules import SIZE, Cell
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.commands import teleport_command
from mc_nested.live.fingerprint import check_single_player, game_in
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.profile import Profile, save_profile
from mc_nested.live.profile_tables import Arena
from mc_nested.live.reading import Block
from mc_nested.live.session import overlay_of

MIDDLE: Cell = (SIZE // 2, SIZE // 2)

EDGES: tuple[tuple[Cell, float], ...] = (
    ((SIZE // 2, SIZE - 1), 0.0),
    ((SIZE - 1, SIZE // 2), 90.0),
    ((SIZE // 2, 0), 180.0),
    ((0, SIZE // 2), -90.0),
)
"""Cells in front of the middle of each border, and the turn, in degrees to the right, that looks at it from there."""


def calibrate_built_arena(
    profile_name: str | Path,
    bench_of: BenchOf,
    *,
    standing: Cell = NEAR_MIDDLE,
    font: Path | None = None,
    yes: bool = False,
    is_server_allowed: bool = False,
) -> tuple[Found, Path]:
    """Build the arena as ``build_arena`` does, and write it into a profile; what was found, and the profile's file.

    ``font`` is the client jar or font picture to read with, noted in the profile; left out, the profile's own.
    """
    path, profile, _ = begun(profile_name, standing, font)
    with saying_how_to_undo(path), bench_of(profile) as bench:
        found = build_arena(bench, profile, path=path, standing=standing, yes=yes, is_server_allowed=is_server_allowed)
    with saying_how_to_undo(path):
        save_profile(found.profile, path)
    forget_known_copy(found.profile, path)
    keep_or_warn(bench.say, path, [found])
    return found, path


def shipped_materials() -> tuple[str, ...]:
    """The blocks that the shipped scenarios are built of, in the order of the hotbar."""
    return tuple(material.block for material in load_scenario("line").materials)


def build_arena(
    bench: Bench,
    profile: Profile,
    *,
    path: Path | None = None,
    standing: Cell = NEAR_MIDDLE,
    yes: bool = False,
    is_server_allowed: bool = False,
) -> Found:
    """Mark and build the arena around the player; the profile with it, and with the version that the title says.

    Nothing is touched before the person has said yes, or with ``yes`` without asking. What stood there is copied into
    the sky first, wherever the game can copy, and ``arena.copied_to`` says where.

    Args:
        bench: the devices and the person.
        profile: with the font.
        path: the profile's file: the copy is noted beside it before anything is built, and a copy that was noted
            earlier, and never undone, is kept. Left out, nothing is noted.
        standing: the cell that the player stands on.
        yes: build without asking.
        is_server_allowed: build in a game that others may share, too.

    Raises:
        DesktopError: a game that others may share; nothing was pressed.
        UserError: a stand that can't be the arena's, a world without commands, a place that isn't loaded, or a no.
        NotConfirmedError: what was built is not what is seen.
        NotInFrontError, UnreadableError: the game isn't in front, or its debug screen can't be read.
    """
    if profile.world is not None:
        raise UserError(
            "the profile's [world] has no commands: mark the arena only, with mc-nested calibrate arena --mark-only"
        )
    blocks = shipped_materials()
    screen = WindowScreen(bench.desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    bench.say("Stand on the middle of the arena's near edge and look across it; then leave mouse and keys alone.")
    reading = read_at_rest(bench.desktop.display, bench.desktop.clock, screen.read)
    check_single_player(bench.desktop.display.title(), is_server_allowed=is_server_allowed)
    arena = arena_seen(reading, standing)
    profile = profile.model_copy(update={"game": game_in(bench.desktop.display.title(), profile.game)})
    console = Console(bench, profile, screen)
    questions = Questions(console, profile, screen, arena.yaw)
    ground = looked_over(console, questions, profile, arena, standing)
    before = Picture("The place of the arena, before", without_chat(bench.desktop.display.grab(), screen.scale()))
    noted = noted_copy(path) if path else None
    old = noted.arena if noted else profile.arena
    first = _first_copy(questions, arena, [each.arena for each in (noted, profile) if each and each.arena])
    if first is not None:
        ground, arena = dataclasses.replace(ground, copy_to=None), _with_copy(arena, first)
    elif path and noted and noted.arena and _stands_in_part(questions, noted.arena, arena):
        raise UserError(
            "an arena of a calibration that ended early stands here: put back what stood there before, with "
            f"{undo_command(path)}, or stand where you stood then"
        )
    if not yes and not bench.ask(question(arena, ground, old, blocks)):
        raise UserError("the arena was not built: nothing was changed, in the world or in the profile")
    if ground.copy_to is not None:
        arena = _copied(console, questions, arena, ground.copy_to)
        how = how_to_undo(arena)
        if path:
            note_copy(profile.model_copy(update={"arena": arena}), path)
            how = f"From now on it is put back by {undo_command(path)}"
        bench.say(f"A copy of what stands there is at {ground.copy_to}. {how}")
    for command in build_commands(profile, arena, blocks, builds_floor=not ground.keeps_floor):
        console.send(command)
    built = _seen_built(console, profile, arena, blocks, floor=ground.floor if ground.keeps_floor else FLOOR)
    console.send(teleport_command(arena, standing, profile.body.pitch))
    console.watch(lambda seen: seen.pitch is not None and abs(seen.pitch - profile.body.pitch) < 1, 1.0)
    after = Picture("The arena", without_chat(bench.desktop.display.grab(), screen.scale()))
    return Found(
        "arena", profile.model_copy(update={"arena": arena}), tuple(lines(arena, ground)), built, (before, after)
    )


def _first_copy(questions: Questions, arena: Arena, earlier: Sequence[Arena]) -> Block | None:
    """Where a copy lies, if any does, of what stood at the same place before any arena did."""
    for old in earlier:
        if old.copied_to and box_of(old) == box_of(arena) and not is_copy_gone(questions, old):
            return old.copied_to
    return None


def _stands_in_part(questions: Questions, old: Arena, arena: Arena) -> bool:
    """Whether an old arena, whose copy is there, has blocks in common with this one."""
    return do_meet(box_of(old), box_of(arena)) and not is_copy_gone(questions, old)


def _copied(console: Console, questions: Questions, arena: Arena, to: Block) -> Arena:
    box = box_of(arena)
    console.send(copy_command(box, to))
    if not questions.are_alike(box, to):
        raise NotConfirmedError(f"the copy to {to} was not seen to be made: nothing else was changed, try again")
    return _with_copy(arena, to)


def _with_copy(arena: Arena, to: Block) -> Arena:
    return arena.model_copy(update={"copied_to": to})


def _seen_built(console: Console, profile: Profile, arena: Arena, materials: Sequence[str], *, floor: str) -> int:
    """See the floor in the arena's middle and each border; how many looks that took."""
    pitch, prefix = profile.body.pitch, profile.blocks.shown_prefix
    x, y, z = arena.block_of((MIDDLE[0], MIDDLE[1] + 1))
    expected = [(MIDDLE, 0.0, (x, y - 1, z), floor)]
    outside = {0.0: (0, 1), 90.0: (1, 0), 180.0: (0, -1), -90.0: (-1, 0)}
    for cell, turn in EDGES:
        right, forward = outside[turn]
        block = arena.block_of((cell[0] + right, cell[1] + forward))
        expected.append((cell, turn, block, border_block(materials)))
    for cell, turn, block, name in expected:
        east, up, south = arena.centre_of(cell)
        yaw = (arena.yaw + turn + 180) % 360 - 180
        target = turned(console, f"{east:.1f} {up:.0f} {south:.1f} {yaw:g} {pitch:g}", yaw, pitch)
        if target is None or target.pos != block or target.id != prefix + name:
            seen = f"{target.id} at {target.pos}" if target else "nothing"
            raise NotConfirmedError(
                f"{name} should be seen at {block}, the screen says {seen}: are cheats on, and is the version right "
                f"({profile.game.version})? {how_to_undo(arena)}"
            )
    return len(expected)
