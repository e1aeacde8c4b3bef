"""Survey the ground before an arena is built there, without changing anything: by looking at it, and by commands.

From 1.13 on a command can be conditional. Each query turns the player's view to one pitch if the condition holds and to
another if it doesn't. If neither happens, the game doesn't know the command, or the blocks aren't loaded. 1.12 can ask
about a single block only; for regions its chat shows how many blocks were compared (FACTS: Commands). Where 1.12 shows
no answer, the answer is unknown.
"""

import math
from dataclasses import dataclass

from calibration.arena.plan import box_at, copy_positions, is_good_floor, volume
from calibration.command_console import CommandConsole
from mc_nested.arena.action import Cell
from mc_nested.errors import UserError
from mc_nested.live.menus.reset import box_text
from mc_nested.live.model.coordinates import EYES, turn_between
from mc_nested.live.model.debug_entries import NONE_NAMED, have_block_named
from mc_nested.live.model.reading import Block, Reading, Target
from mc_nested.live.profile.arena import Arena, Box, box_of, floor_of
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.game_screen import GameScreen

SIGHT = 19.5
"""Blocks from the eyes to the farthest floor that is looked at (FACTS: The F3 debug screen)."""

ACROSS, ALONG = (1, 4, 7, 10, 13), (3, 8, 13)
"""Where the cells lie whose floor is looked at, in fifteenths of the arena's size, spread over it."""

VIEW_S = 1.0
"""How long a new view may take to be seen."""

ANGLE_TOLERANCE_DEG = 0.2
"""How far the view may differ from what a command asked for: the debug screen shows tenths."""


@dataclass(frozen=True)
class LookAroundResult:
    """Blocks that stand in the arena's way, and how many of the looks saw the expected floor.

    ``out_of_sight`` cells were too far away to be looked at.
    """

    in_the_way: dict[Block, str]
    floor: int
    looks: int
    out_of_sight: int = 0


def cells_to_look_at(size: int) -> list[Cell]:
    """Return cells spread over an arena."""
    return [(size * x // 15, size * y // 15) for y in ALONG for x in ACROSS]


def is_in_sight(cell: Cell, standing: Cell) -> bool:
    """Return whether a cell's floor can be seen from ``standing``: always, in an arena of 15 cells a side."""
    return math.hypot(math.dist(cell, standing), EYES) <= SIGHT


def look_around(console: CommandConsole, arena: Arena, standing: Cell) -> LookAroundResult:
    """Look at the floor of some cells; the player's feet stay where they are, on the cell ``standing``."""
    in_the_way: dict[Block, str] = {}
    floor = 0
    spread = cells_to_look_at(arena.size)
    cells = [cell for cell in spread if is_in_sight(cell, standing)]
    for cell in cells:
        x, y, z = arena.block_of(cell)
        target = look_at(console, (x + 0.5, float(y), z + 0.5))
        if target is None or target.pos is None:
            continue
        if target.pos == (x, y - 1, z):
            floor += 1
        elif target.pos[1] >= y:
            in_the_way[target.pos] = target.id or "a block"
    return LookAroundResult(in_the_way, floor, len(cells), len(spread) - len(cells))


def look_at(console: CommandConsole, point: tuple[float, float, float]) -> Target | None:
    """Turn the view to a point and return the block that is seen there, or None."""
    feet = console.read().xyz or point
    east, down, south = point[0] - feet[0], feet[1] + EYES - point[1], point[2] - feet[2]
    yaw, pitch = math.degrees(math.atan2(-east, south)), math.degrees(math.atan2(down, math.hypot(east, south)))
    return teleport_and_look(console, f"~ ~ ~ {yaw:.1f} {pitch:.1f}", yaw, pitch)


def teleport_and_look(console: CommandConsole, pose: str, yaw: float, pitch: float) -> Target | None:
    """Teleport to ``pose``, which includes the view, and return the block that is seen from there, or None."""
    console.send(f"/tp @s {pose}")

    def is_there(reading: Reading) -> bool:
        return (
            reading.yaw is not None
            and reading.pitch is not None
            and turn_between(reading.yaw, yaw) <= ANGLE_TOLERANCE_DEG
            and abs(reading.pitch - pitch) <= ANGLE_TOLERANCE_DEG
        )

    reading = console.watch(is_there, VIEW_S)
    return reading.target if reading else None


ANSWER_S = 0.8
"""How long an answer may take: a command is done within a tick or two, and seen a frame later."""

_FIRST_PITCH, _PITCHES = 20, 40
"""Answers turn the view down by whole degrees, from the first on, one after the other, so that each differs."""


class BlockQueries:
    """Questions about blocks, asked by commands: each answer is True, False, or None if unknown.

    Args:
        console: sends the commands and watches the debug screen.
        profile: has the game's version.
        screen: reads the window.
        yaw: the direction in which the player keeps looking, in degrees.
    """

    def __init__(self, console: CommandConsole, profile: Profile, screen: GameScreen, yaw: float) -> None:
        self._console, self._screen, self._yaw = console, screen, yaw
        self._is_1_12 = profile.game.dialect == "1.12"
        self._reads_chat = profile.input.reads_chat
        self._queries_sent = 0

    def is_air(self, block: Block) -> bool | None:
        """Return whether a block is air."""
        xyz = " ".join(map(str, block))
        if self._is_1_12:
            return True if self._turns_view(f"/execute @s ~ ~ ~ detect {xyz} minecraft:air 0") else None
        return self._if_or_unless(f"block {xyz} minecraft:air")

    def are_alike(self, box: Box, other: Block) -> bool | None:
        """Return whether a box holds the same blocks as the box of its size whose lowest corner is ``other``."""
        xyz = " ".join(map(str, other))
        if not self._is_1_12:
            return self._if_or_unless(f"blocks {box_text(box)} {xyz} all")
        if not self._reads_chat:
            return None
        self._console.clear()
        self._console.send(f"/testforblocks {box_text(box)} {xyz}")
        answer = f"{volume(box)} blocks compared"
        seen = self._console.watch(lambda _: self._screen.position_of(answer) is not None, ANSWER_S)
        return True if seen else None

    def is_uniform(self, box: Box) -> bool | None:
        """Return whether a flat box is all of one block: it and its first row equal themselves shifted by one block."""
        (x, y, z), (other_x, _, other_z) = box
        along = self.are_alike(((x, y, z), (other_x - 1, y, other_z)), (x + 1, y, z))
        return along and self.are_alike(((x, y, z), (x, y, other_z - 1)), (x, y, z + 1))

    def _if_or_unless(self, condition: str) -> bool | None:
        if self._turns_view(f"/execute if {condition} run"):
            return True
        return False if self._turns_view(f"/execute unless {condition} run") else None

    def _turns_view(self, prefix: str) -> bool:
        pitch = _FIRST_PITCH + self._queries_sent % _PITCHES
        self._queries_sent += 1
        self._console.send(f"{prefix} tp @s ~ ~ ~ {self._yaw:g} {pitch}")

        def is_turned(reading: Reading) -> bool:
            return reading.pitch is not None and abs(reading.pitch - pitch) <= ANGLE_TOLERANCE_DEG

        return self._console.watch(is_turned, ANSWER_S) is not None


@dataclass(frozen=True)
class GroundSurvey:
    """The facts about the ground before anything is built. None means unknown.

    ``floor`` is the id of the block seen in front of the player's feet. ``copy_to`` is where the copy will lie.
    """

    is_free: bool | None
    is_flat: bool | None
    floor: str
    copy_to: Block | None
    view: LookAroundResult | None = None

    @property
    def keeps_floor(self) -> bool:
        """Whether the existing floor is good enough."""
        return self.is_flat is True and is_good_floor(self.floor)


def survey_ground(
    console: CommandConsole, queries: BlockQueries, profile: Profile, arena: Arena, standing: Cell
) -> GroundSurvey:
    """Find out what stands in the arena, as far as that is possible without changing anything."""
    x, y, z = arena.centre_of(standing)
    pitch = profile.body.pitch
    target = teleport_and_look(console, f"{x:.1f} {y:.0f} {z:.1f} {arena.yaw:g} {pitch:g}", arena.yaw, pitch)
    if target is None or target.id is None:
        raise UserError(_why_unseen(console.read(), pitch, profile.game.version))
    floor = target.id.removeprefix(profile.blocks.shown_prefix)
    is_free: bool | None = None
    is_flat: bool | None = None
    copy_to: Block | None = None
    if queries.is_air(arena.block_of(standing)) is not None:
        copy_to = _free_copy_position(queries, arena, profile.game.version)
        if copy_to is not None:
            # Compared with the air above the copy's floor. The border is left out, so the region is smaller.
            is_free = queries.are_alike(arena.region, (copy_to[0] + 1, copy_to[1] + 1, copy_to[2] + 1))
        is_flat = queries.is_uniform(floor_of(arena))
        if is_flat is None and profile.game.dialect != "1.12":
            raise UserError("part of the ground isn't loaded: go nearer to its middle, or raise the render distance")
    view = None if is_free and is_flat else look_around(console, arena, standing)
    return GroundSurvey(is_free, is_flat, floor, copy_to, view)


def is_copy_gone(queries: BlockQueries, arena: Arena) -> bool:
    """Return whether the arena's copy is gone: only air is there, as above it. False if that is unknown."""
    if arena.copied_to is None:
        return True
    copy = box_at(box_of(arena), arena.copied_to)
    x, _, z = arena.block_of(arena.near_middle)
    # One block of its floor mostly decides it. If that is air, the copied floor may just have had a hole there.
    if queries.is_air((x, copy[0][1], z)) is not True:
        return False
    return queries.are_alike(copy, (copy[0][0], copy[1][1] + 1, copy[0][2])) is True


def _free_copy_position(queries: BlockQueries, arena: Arena, version: str) -> Block | None:
    """Return where the copy can lie: a box that equals the box above it and has air at its corner, so is all air."""
    box = box_of(arena)
    for corner in copy_positions(arena, version):
        copy = box_at(box, corner)
        above = (corner[0], copy[1][1] + 1, corner[2])
        if queries.is_air(corner) and queries.are_alike(copy, above):
            return corner
    return None


def _why_unseen(reading: Reading, pitch: float, version: str) -> str:
    """Return why no block is seen after a teleport that should look at the ground, and what to do."""
    if reading.pitch is None or abs(reading.pitch - pitch) > ANGLE_TOLERANCE_DEG:
        return "a teleport had no effect: allow cheats"
    return f"{NONE_NAMED}: {have_block_named(version)}"
