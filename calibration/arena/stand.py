"""Marking the arena: the player stands on its ground and looks across it, and the debug screen says where that is.

far edge  . . . . . . .
          . . . . . . .     the player looks this way, along an axis of the world
near edge . . . P . . .     and stands, unless told otherwise, in the middle of the near edge
"""

import math
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

from calibration.start import profile_to_calibrate
from mc_nested.arena.rules import SIZE, Cell, is_inside
from mc_nested.errors import ProfileError, UserError
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.coordinates import block_of, facing_of, turn_between, yaw_of
from mc_nested.live.debug_screen import read_debug_screen
from mc_nested.live.desktop import Desktop, open_desktop
from mc_nested.live.fingerprint import version_in
from mc_nested.live.font import Font, load_font
from mc_nested.live.profile import Profile, save_profile
from mc_nested.live.profile_tables import Arena, GameVersion
from mc_nested.live.reading import Reading
from mc_nested.live.session import overlay_of

NEAR_MIDDLE: Cell = (SIZE // 2, 0)
"""The cell that the player stands on unless told otherwise: in front of it lies the whole arena, in plain view."""

TOLERANCE_DEG = 20.0
"""How far the view may be off an axis of the world and still mean it; halfway between two axes is 45."""

FLOOR_TOLERANCE = 0.001
"""How far the feet may be off a whole block's top, in blocks: the debug screen shows three decimals at least."""


def calibrate_arena(
    profile_name: str | Path,
    *,
    ask: Callable[[str], bool],
    say: Callable[[str], None],
    standing: Cell = NEAR_MIDDLE,
    font: Path | None = None,
    yes: bool = False,
    open_devices: Callable[[str], AbstractContextManager[Desktop]] = open_desktop,
) -> Path | None:
    """Write where the player stands and looks into a profile, as its arena; the profile's file, or None if declined.

    The game's version, by which commands are written, is taken from the window's title where that says it.

    Args:
        profile_name: a name or a file; a new profile is made where there is none.
        ask: puts a question to the player; whether the answer is yes.
        say: tells the player what to do.
        standing: the cell that the player stands on.
        font: the client jar or font picture to read with, noted in the profile; left out, the profile's own.
        yes: mark without asking.
        open_devices: opens the window of a title.

    Raises:
        UserError: a profile, font or desktop that can't be used, or a stand that can't be the arena's.
        LiveError: the game did not come to the front, or its debug screen could not be read.
    """
    path, profile, glyphs = begun(profile_name, standing, font)
    with open_devices(profile.window.title) as desktop:
        say(
            f"Switch to the game, stand on {_in_words(standing)}, look across it "
            f"along an axis of the world, and turn the debug screen on (F3). Stand still."
        )
        overlay = overlay_of(profile)
        reading = read_at_rest(
            desktop.display, desktop.clock, lambda: read_debug_screen(desktop.display.grab(), glyphs, overlay)
        )
        titled = version_in(desktop.display.title())
    game = GameVersion(version=titled) if titled else profile.game
    arena = arena_seen(reading, standing)
    if not yes and not ask(question_for(arena)):
        return None
    save_profile(profile.model_copy(update={"arena": arena, "game": game}), path)
    whence = "from its title" if titled else f"not in its title: if that is wrong, mend game.version in {path}"
    say(f"Commands will be written for Minecraft {game.version}, {whence}.")
    return path


def begun(profile_name: str | Path, standing: Cell, font: Path | None) -> tuple[Path, Profile, Font]:
    """The profile's file, what it says with that font noted in it, and the font; before a window is looked for.

    UserError for a cell outside the arena, or a profile or font that can't be used.
    """
    check_standing(standing)
    path, profile = profile_to_calibrate(profile_name)
    if font is not None:
        screen = profile.screen.model_copy(update={"font": str(font.expanduser().resolve())})
        profile = profile.model_copy(update={"screen": screen})
    if profile.screen.font is None:
        raise ProfileError("the game's font is needed the first time: name its client jar with --font")
    return path, profile, load_font(profile.screen.font_path())


def check_standing(standing: Cell) -> None:
    """UserError for a cell outside the arena."""
    if not is_inside(standing):
        raise UserError(f"cell {standing} lies outside the arena: choose 0 to {SIZE - 1} for x and y")


def arena_seen(reading: Reading, standing: Cell) -> Arena:
    """The arena of a player who stands on cell ``standing`` and looks forward; UserError where that can't be."""
    if reading.xyz is None or reading.yaw is None:
        raise UserError("the debug screen shows no place or no facing: turn the whole of it on (F3)")
    facing = facing_of(reading.yaw)
    off = turn_between(reading.yaw, yaw_of(facing))
    if off > TOLERANCE_DEG:
        side = "right" if (yaw_of(facing) - reading.yaw) % 360 < 180 else "left"
        raise UserError(f"you look between two axes: turn {off:.0f} degrees to the {side} to face {facing}")
    x, y, z = reading.xyz
    if abs(y - round(y)) > FLOOR_TOLERANCE:
        raise UserError(f"your feet are at height {y:g}: stand still on the top of a whole block, on a level floor")
    there = (math.floor(x), round(y), math.floor(z))
    shift = block_of((0, 0, 0), facing, standing)
    origin = (there[0] - shift[0], there[1], there[2] - shift[2])
    return Arena.around(origin, facing)


def question_for(arena: Arena) -> str:
    """What the player is asked before the region is marked. What stands in it can't be seen from where they stand."""
    low, high = arena.region
    size = " x ".join(str(high[axis] - low[axis] + 1) for axis in (0, 2, 1))
    return (
        f"Every reset will remove all blocks from {low} to {high} (x, y, z; {size} high), facing {arena.facing}. "
        "What stands there now is not known: make sure that it is only air above your floor. Mark it?"
    )


def _in_words(cell: Cell) -> str:
    return "the middle of the arena's near edge" if cell == NEAR_MIDDLE else f"cell {cell} of the arena"
