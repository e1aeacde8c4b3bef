"""What is known of a place before an arena is built there, found out without touching any of it."""

from dataclasses import dataclass

from calibration.arena.plan import box_of, copy_places, floor_of, is_fit, moved
from calibration.arena.questions import Questions
from calibration.arena.sight import Sights, look_around, turned
from calibration.arena.stand import NEAR_MIDDLE
from calibration.console import Console
from mc_nested.arena.rules import Cell
from mc_nested.errors import UserError
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Arena
from mc_nested.live.reading import Block


@dataclass(frozen=True)
class Ground:
    """What is known of a place before anything is built: None where it can't be told.

    ``copy_to`` is where a copy will lie; ``floor`` the name of the block seen in front of the player's feet.
    """

    is_free: bool | None
    is_flat: bool | None
    floor: str
    copy_to: Block | None
    sights: Sights | None = None

    @property
    def keeps_floor(self) -> bool:
        """Whether the floor that is there will do."""
        return self.is_flat is True and is_fit(self.floor)


def looked_over(console: Console, questions: Questions, profile: Profile, arena: Arena, standing: Cell) -> Ground:
    """What stands in the way, as far as it can be told without touching anything."""
    x, y, z = arena.centre_of(standing)
    pitch = profile.body.pitch
    target = turned(console, f"{x:.1f} {y:.0f} {z:.1f} {arena.yaw:g} {pitch:g}", arena.yaw, pitch)
    if target is None or target.id is None:
        raise UserError(
            "the block looked at is not seen, or a teleport had no effect: allow cheats, and from Minecraft 1.21.9 on "
            "switch the looked-at block on (F3+F6)"
        )
    name = target.id.removeprefix(profile.blocks.shown_prefix)
    free: bool | None = None
    flat: bool | None = None
    copy_to: Block | None = None
    if questions.is_air(arena.block_of(standing)) is not None:
        copy_to = _place_in_the_sky(questions, arena, profile.game.version)
        if copy_to is not None:
            # The air over the copy's floor-to-be, to compare with: the region is as wide, less the border.
            free = questions.are_alike(arena.region, (copy_to[0] + 1, copy_to[1] + 1, copy_to[2] + 1))
        flat = questions.is_uniform(floor_of(arena))
        if flat is None and profile.game.dialect != "1.12":
            raise UserError("part of the place isn't loaded: go nearer to its middle, or raise the render distance")
    sights = None if free and flat else look_around(console, arena)
    return Ground(free, flat, name, copy_to, sights)


def is_copy_gone(questions: Questions, arena: Arena) -> bool:
    """Whether no copy is where the arena's lies: there is only air, as above it. False where that can't be told."""
    if arena.copied_to is None:
        return True
    copy = moved(box_of(arena), arena.copied_to)
    x, _, z = arena.block_of(NEAR_MIDDLE)
    # One block of its floor tells it mostly; what was copied may have had a hole there.
    if questions.is_air((x, copy[0][1], z)) is not True:
        return False
    return questions.are_alike(copy, (copy[0][0], copy[1][1] + 1, copy[0][2])) is True


def _place_in_the_sky(questions: Questions, arena: Arena, version: str) -> Block | None:
    """Where a copy can lie: a place that is all air, being like the one above it, with air at its corner."""
    box = box_of(arena)
    for place in copy_places(arena, version):
        there = moved(box, place)
        above = (place[0], there[1][1] + 1, place[2])
        if questions.is_air(place) and questions.are_alike(there, above):
            return place
    return None
