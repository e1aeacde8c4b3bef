"""Marks the arena: the player stands in it and looks across it, and the debug screen says where that is.

far edge  . . . . . . .
          . . . . . . .     the player looks this way, along an axis of the world
near edge . . . P . . .     and stands, by default, in the middle of the near edge
"""

import math
from collections.abc import Callable
from pathlib import Path

from calibration.context import OpenContext
from calibration.step_profile import starting_profile
from mc_nested.arena.action import LARGEST_SIZE, Cell
from mc_nested.arena.rules import is_inside
from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.errors import ProfileError, UserError
from mc_nested.live.devices import SWITCH_KEYS
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.coordinates import block_of, facing_of, turn_between, yaw_of
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.arena import Arena, near_middle
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import GameVersion, Profile
from mc_nested.live.vision.font import load_font

TOLERANCE_DEG = 20.0
"""How far the view may differ from an axis of the world and still mean it; halfway between two axes is 45."""

HEIGHT_TOLERANCE = 0.001
"""How far the feet may be from a whole block's top, in blocks: the debug screen shows at least three decimals."""


def mark_arena(
    profile_name: str | Path,
    context_of: OpenContext,
    *,
    ask: Callable[[str], bool],
    say: Callable[[str], None],
    size: int = DEFAULT_SIZE,
    standing: Cell | None = None,
    font: Path | None = None,
    yes: bool = False,
) -> Path | None:
    """Write the arena that the player stands in into a profile. Returns the profile's file, or None if declined.

    The game's version, which decides the syntax of commands, is taken from the window's title if that names it.

    Args:
        profile_name: a name or a file; a new profile is made if there is none.
        context_of: opens the window.
        ask: asks the player a yes-or-no question.
        say: tells the player what to do.
        size: cells along each side of the arena.
        standing: the cell that the player stands on; default: the middle of the near edge.
        font: the client jar or font picture to read with, recorded in the profile; default: the profile's own.
        yes: mark without asking.

    Raises:
        UserError: the profile, font or desktop can't be used, or no arena can be where the player stands.
        LiveError: the game did not come to the front, or its debug screen could not be read.
    """
    standing = near_middle(size) if standing is None else standing
    path, profile = load_profile_with_font(profile_name, standing, size, font)
    with context_of(profile) as context:
        middle = "the middle of the arena's near edge"
        cell = middle if standing == near_middle(size) else f"cell {standing} of the arena"
        say(
            f"Switch to the game with {SWITCH_KEYS}, stand on {cell}, look across it "
            f"along an axis of the world, and turn the debug screen on (F3). Stand still."
        )
        reading = wait_until_standing_still(context.connection.for_profile(profile))
        title_version = version_in(context.devices.display.title())
    game = GameVersion(version=title_version) if title_version else profile.game
    arena = arena_from_reading(reading, standing, size)
    if not yes and not ask(mark_question(arena)):
        return None
    save_profile(profile.model_copy(update={"arena": arena, "game": game}), path)
    source = "from its title" if title_version else f"not in its title: if that is wrong, mend game.version in {path}"
    say(f"Commands will be written for Minecraft {game.version}, {source}.")
    return path


def load_profile_with_font(
    profile_name: str | Path, standing: Cell, size: int, font: Path | None
) -> tuple[Path, Profile]:
    """Return the profile's file and the profile, with that font recorded in it. No window is needed.

    UserError as ``check_standing``, or if the profile or font can't be used.
    """
    check_standing(standing, size)
    path, profile = starting_profile(profile_name)
    if font is not None:
        screen = profile.screen.model_copy(update={"font": str(font.expanduser().resolve())})
        profile = profile.model_copy(update={"screen": screen})
    if profile.screen.font is None:
        raise ProfileError("the game's font is needed the first time: name its client jar with --font")
    load_font(profile.screen.font_path())
    return path, profile


def check_standing(standing: Cell, size: int) -> None:
    """Raise UserError for a size that no arena in a game has, or for a cell outside the arena."""
    if not DEFAULT_SIZE <= size <= LARGEST_SIZE:
        raise UserError(
            f"an arena of {size} x {size} cells: choose {DEFAULT_SIZE} to {LARGEST_SIZE} cells along each side; a "
            "smaller scenario is played in a part of it"
        )
    if not is_inside(standing, size):
        raise UserError(f"cell {standing} lies outside the arena: choose 0 to {size - 1} for x and y")


def arena_from_reading(reading: Reading, standing: Cell, size: int) -> Arena:
    """Return the arena of a player who stands on cell ``standing`` and looks forward. UserError if there can be none.

    ``size`` is the number of cells along each side.
    """
    if reading.xyz is None or reading.yaw is None:
        raise UserError("the debug screen shows no position or no facing: turn the whole of it on (F3)")
    facing = facing_of(reading.yaw)
    degrees_off = turn_between(reading.yaw, yaw_of(facing))
    if degrees_off > TOLERANCE_DEG:
        side = "right" if (yaw_of(facing) - reading.yaw) % 360 < 180 else "left"
        raise UserError(f"you look between two axes: turn {degrees_off:.0f} degrees to the {side} to face {facing}")
    x, y, z = reading.xyz
    if abs(y - round(y)) > HEIGHT_TOLERANCE:
        raise UserError(f"your feet are at height {y:g}: stand still on the top of a whole block, on a level floor")
    feet = (math.floor(x), round(y), math.floor(z))
    shift = block_of((0, 0, 0), facing, standing)
    origin = (feet[0] - shift[0], feet[1], feet[2] - shift[2])
    return Arena.around(origin, facing, size=size)


def mark_question(arena: Arena) -> str:
    """Return the question before the region is marked. What stands in it can't be seen from where the player stands."""
    low, high = arena.region
    size = " x ".join(str(high[axis] - low[axis] + 1) for axis in (0, 2, 1))
    return (
        f"Every reset will remove all blocks from {low} to {high} (x, y, z; {size} high), facing {arena.facing}. "
        "What stands there now is not known: make sure that it is only air above your floor. Mark it?"
    )
