"""Measuring how the player walks: which keys go which way, how far a hold leads, and when it is felt and seen.

sneak a little with each key -> sneak out and back: that far the floor is free -> walk there, at all lengths and phases
-> fit -> some holds more, timed between two ticks and predicted before they are pressed -> back to where it began
"""

from pathlib import Path

import cv2

from calibration.bench import BenchOf
from calibration.console import Console
from calibration.report.kept import keep_or_warn
from calibration.start import profile_to_calibrate
from calibration.step import Bench, Found
from calibration.walk.figure import picture_of_walk
from calibration.walk.fit import rms
from calibration.walk.gauge import PLAIN_SPEED, Gauge, gauged
from calibration.walk.keys import keys_in_words
from calibration.walk.survey import AHEAD, SIDES, Survey
from calibration.walk.walker import Pose, Walker
from mc_nested.arena.rules import SIZE, Cell
from mc_nested.errors import NotConfirmedError, ProfileError
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.commands import clear_command, teleport_command
from mc_nested.live.fingerprint import check_single_player
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.profile import Profile, save_profile
from mc_nested.live.profile_tables import Arena
from mc_nested.live.session import overlay_of
from mc_nested.live.walk import TICK_S, nearest_ticks

MIDDLE: Cell = (SIZE // 2, SIZE // 2)
"""Where an arena leaves the most room around the player."""

TIMED = (5, 5, 4, 4, 6, 6, 2, 2)
"""Ticks of the holds that are predicted before they are pressed, there and back: most of them as for one cell."""

NEAR = 0.15
"""Blocks from where it began at which the walker needn't walk back any more."""

MOST_BACK = 6
"""Holds that the way back may take."""


def calibrate_walk(
    profile_name: str | Path, bench_of: BenchOf, *, is_server_allowed: bool = False
) -> tuple[Found, Path]:
    """Measure how the player of a profile's game walks and write it into the profile; what was found, and its picture.

    Args:
        profile_name: a name or a file.
        bench_of: opens the window.
        is_server_allowed: measure in a game that others may share, too.

    Raises as ``walk``, and ProfileError where the profile or the picture can't be written.
    """
    path, profile = profile_to_calibrate(profile_name)
    if profile.screen.font is None:
        raise ProfileError("places are read with the game's font: run mc-nested calibrate font first")
    profile.screen.font_path()  # before a window is looked for
    with bench_of(profile) as bench:
        found = walk(bench, profile, is_server_allowed=is_server_allowed)
    save_profile(found.profile, path)
    keep_or_warn(bench.say, path, [found])
    picture = path.with_name(f"{path.stem}-walk.png")
    try:
        picture.write_bytes(cv2.imencode(".png", found.pictures[0].frame)[1].tobytes())
    except OSError as error:
        raise ProfileError(f"{picture}: the picture can't be written ({error}); the profile is written") from error
    return found, picture


def walk(bench: Bench, profile: Profile, *, is_server_allowed: bool = False) -> Found:
    """Measure how the player walks; the profile with its [walk] table, and the keys as they really go.

    It walks in the middle of the marked arena, cleared as by every reset, where there is one and commands are allowed;
    else about where the player stands, never farther than ``walk_survey.REACH`` blocks. It ends where it began.

    Raises:
        ProfileError, FontError: the profile names no font, or one that can't be used.
        DesktopError: a game that others may share, unless ``is_server_allowed``; nothing was pressed.
        UserError: keys that don't go four ways, or a floor that isn't free.
        NotConfirmedError: what was seen can't be explained; the keys are up.
        NotInFrontError, UnreadableError: the game isn't in front, or its debug screen can't be read.
    """
    screen = WindowScreen(bench.desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    bench.say("Measuring how you walk, for about a minute: leave mouse and keys alone.")
    read_at_rest(bench.desktop.display, bench.desktop.clock, screen.read)
    check_single_player(bench.desktop.display.title(), is_server_allowed=is_server_allowed)
    walker, console = Walker(bench, profile, screen), Console(bench, profile, screen)
    began = walker.look()
    if profile.arena is not None and profile.world is None:
        _teleport_into(profile.arena, console, profile, walker)
    survey = Survey(walker, profile.keys, bench.desktop.clock)
    keys = survey.find_keys()
    survey.find_floor()
    survey.walk()
    gauge = gauged(survey.holds)
    predicted = _predict(gauge, survey)
    gauge = gauged(survey.holds)
    if profile.arena is not None and profile.world is None:
        console.send(_back_to(began))
        _arrive(walker, began)
    else:
        _walk_back(gauge, survey)
    lines = (
        f"Keys: {keys_in_words(profile.keys, keys)}.",
        *_words(gauge),
        _words_of_timed(predicted),
        *_warnings(gauge, profile),
    )
    return Found(
        "walk",
        profile.model_copy(update={"keys": keys, "walk": gauge.table}),
        lines,
        len(gauge.good),
        (picture_of_walk(gauge),),
    )


def _predict(gauge: Gauge, survey: Survey) -> list[float | None]:
    """How far off each timed hold ended of where it was predicted, in blocks; None where it wasn't felt as asked."""
    phase = gauge.beat - gauge.trip + TICK_S / 2
    offs: list[float | None] = []
    for index, ticks in enumerate(TIMED):
        held = survey.hold_homewards((AHEAD, SIDES)[index // 2 % 2], ticks, phase)
        track = held.track
        off = (track.covered[-1] if track else 0.0) - gauge.walking.covered(ticks)
        offs.append(off if abs(off) < gauge.walking.steady / 2 else None)
    return offs


def _walk_back(gauge: Gauge, survey: Survey) -> None:
    covered = gauge.table.covered
    for axis in (AHEAD, SIDES):
        for _ in range(MOST_BACK):
            offset = abs(survey.offset(axis))
            if offset <= NEAR:
                break
            survey.hold_homewards(axis, max(1, nearest_ticks(offset, covered)), gauge.beat - gauge.trip + TICK_S / 2)


def _teleport_into(arena: Arena, console: Console, profile: Profile, walker: Walker) -> None:
    console.send(clear_command(arena))
    console.send(teleport_command(arena, MIDDLE, profile.body.pitch))
    _arrive(walker, Pose(arena.centre_of(MIDDLE), arena.yaw, profile.body.pitch))


def _back_to(pose: Pose) -> str:
    x, y, z = pose.xyz
    return f"/tp @s {x:.3f} {y:.3f} {z:.3f} {pose.yaw:.1f} {pose.pitch:.1f}"


def _arrive(walker: Walker, pose: Pose) -> None:
    if not walker.arrives(pose):
        x, y, z = pose.xyz
        raise NotConfirmedError(
            f"the teleport to {x:g} {y:g} {z:g} was not seen: are cheats on, and is this the world of the arena?"
        )


def _words(gauge: Gauge) -> list[str]:
    steady, inertia = gauge.walking.steady, gauge.walking.inertia
    one = nearest_ticks(1.0, gauge.table.covered)
    speeds = f"walking {gauge.speed:.3f} blocks a second, sneaking {gauge.sneaking.steady / TICK_S:.3f}"
    fits = f"{len(gauge.good)} holds ended {gauge.off:.4f} blocks (RMS) from where they should"
    cell = f"One cell is {one} ticks, {gauge.table.covered[one - 1]:.3f} blocks"
    return [
        f"{speeds.capitalize()}; a tick leaves {inertia:.3f} of a step.",
        f"{fits}, those that were kept out of the fit {gauge.held_out:.4f}.",
        f"{cell}; the nearest hold ends within {steady / 2:.3f} of a cell's middle, {steady / 4:.3f} on average.",
        f"From a press to its step on the screen: {gauge.trip * 1000:.0f} ms, and up to a tick more.",
    ]


def _words_of_timed(offs: list[float | None]) -> str:
    as_asked = [off for off in offs if off is not None]
    ended = f", and ended {rms(as_asked):.4f} blocks (RMS) from where that was predicted" if as_asked else ""
    return f"Timed between two ticks, {len(as_asked)} of {len(offs)} holds were felt as long as asked{ended}."


def _warnings(gauge: Gauge, profile: Profile) -> list[str]:
    lines = []
    if gauge.is_lagging:
        lines.append(
            f"Warning: the game lags: ticks came late in {gauge.late} holds, and {gauge.lost} were of no use. "
            "Close other programs, or lower the render distance."
        )
    if not gauge.is_plain:
        lines.append(
            f"Warning: a plain walker makes {PLAIN_SPEED:.3f} blocks a second, with 0.546 left of a step. An effect or "
            "another floor? The profile holds for as long as it lasts: /effect clear @s, and calibrate again."
        )
    if gauge.walking.steady / 2 > profile.body.tolerance:
        lines.append(
            "Warning: walking steps are too long to end within the tolerance of a cell's middle; many moves will sneak."
        )
    return lines
