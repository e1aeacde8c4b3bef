"""Surveys the ground before an arena is built there, without changing anything."""

from dataclasses import dataclass

from calibration.arena.block_queries import BlockQueries
from calibration.arena.look_around import ANGLE_TOLERANCE_DEG, LookAroundResult, look_around, teleport_and_look
from calibration.arena.plan import box_at, copy_positions, is_good_floor
from calibration.command_console import CommandConsole
from mc_nested.arena.action import Cell
from mc_nested.errors import UserError
from mc_nested.live.model.debug_entries import NONE_NAMED, have_block_named
from mc_nested.live.model.reading import Block, Reading
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.built_arena import box_of, floor_of
from mc_nested.live.profile.tables import Profile


@dataclass(frozen=True)
class GroundSurvey:
    """What is known of the ground before anything is built. None means unknown.

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
    """Whether the arena's copy is gone: only air is there, as above it. False if that is unknown."""
    if arena.copied_to is None:
        return True
    copy = box_at(box_of(arena), arena.copied_to)
    x, _, z = arena.block_of(arena.near_middle)
    # One block of its floor mostly decides it. If that is air, the copied floor may just have had a hole there.
    if queries.is_air((x, copy[0][1], z)) is not True:
        return False
    return queries.are_alike(copy, (copy[0][0], copy[1][1] + 1, copy[0][2])) is True


def _free_copy_position(queries: BlockQueries, arena: Arena, version: str) -> Block | None:
    """Where the copy can lie: a box that is all air, since it equals the box above it and has air at its corner."""
    box = box_of(arena)
    for corner in copy_positions(arena, version):
        copy = box_at(box, corner)
        above = (corner[0], copy[1][1] + 1, corner[2])
        if queries.is_air(corner) and queries.are_alike(copy, above):
            return corner
    return None


def _why_unseen(reading: Reading, pitch: float, version: str) -> str:
    """Why no block is seen after a teleport that should look at the ground, and what to do."""
    if reading.pitch is None or abs(reading.pitch - pitch) > ANGLE_TOLERANCE_DEG:
        return "a teleport had no effect: allow cheats"
    return f"{NONE_NAMED}: {have_block_named(version)}"
