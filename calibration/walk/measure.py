"""The walk step of calibration: measures which keys go which way, how far a hold leads, and the latencies.

sneak a little with each key -> sneak out and back, to see how far the floor is free (only a little in an arena that was
cleared and its floor refilled) -> walk there, at all lengths and phases -> fit -> a few more holds, timed between two
ticks and predicted before they are pressed -> back to the start, also where any of this fails
"""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from calibration.command_console import CommandConsole
from calibration.context import CalibrationContext, OpenContext, StepResult
from calibration.step_profile import keep_result, starting_profile
from calibration.walk.figure import picture_of_empirical_walk, picture_of_walk
from calibration.walk.gait_fit import rms
from calibration.walk.survey import FORWARD_AXIS, SIDE_AXIS, Survey, describe_keys
from calibration.walk.walk_model import PLAIN_SPEED, EmpiricalWalk, WalkModel, empirical_walk, fit_walk_model
from calibration.walk.walker import Walker
from mc_nested.errors import McNestedError, NotConfirmedError, ProfileError, UnreadableError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.menus.reset import clear_command, floor_commands, teleport_command
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.kinematics import TICK_S, nearest_ticks
from mc_nested.live.model.reading import WorldPose
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseFrame, PoseObserver, PoseReader
from mc_nested.live.profile.tables import KeysTable, Profile, WalkTable

TIMED = (5, 5, 4, 4, 6, 6, 2, 2)
"""Ticks of the holds that are predicted before they are pressed, there and back; most are about one cell long."""

NEAR = 0.15
"""Blocks from the starting point that are near enough to it at the end."""

ARRIVAL_TOLERANCE = 0.01
"""Blocks that a player may be off the position of a teleport."""

MAX_HOLDS_BACK = 6
"""How many holds per axis the return to the start may take."""


WITHOUT_TICKS = (
    "Warning: this game's walk doesn't go in ticks as Minecraft's does, so the profile holds only how far each hold "
    "leads, and playing is slower. If this is Minecraft, close other programs and calibrate again."
)


def calibrate_walk(profile_name: str | Path, context_of: OpenContext) -> tuple[StepResult, Path]:
    """Measure how the player of a profile's game walks and write it into the profile; the result and its picture.

    Args:
        profile_name: a name or a file.
        context_of: opens the window.

    Raises as ``walk``, and ProfileError if the profile or the picture can't be written.
    """
    path, profile = starting_profile(profile_name)
    if profile.screen.font is None:
        raise ProfileError("positions are read with the game's font: run mc-nested calibrate font first")
    profile.screen.font_path()  # fails before a window is searched for
    with context_of(profile) as context:
        found = walk(context, profile)
    return keep_result(found, path, path.with_name(f"{path.stem}-walk.png"), context.say)


def walk(context: CalibrationContext, profile: Profile) -> StepResult:
    """Measure how the player walks, and return the profile with its [walk] table and the keys as they really go.

    If there is a marked arena and commands are allowed, it walks in the arena's middle, cleared as by every reset, with
    its floor refilled if the profile says which block it is made of. Else it walks around where the player stands. It
    never goes farther than ``survey.REACH`` blocks, and ends where it began.

    Raises:
        ProfileError, FontError: the profile names no font, or one that can't be used.
        DesktopError: a game that others may share, unless that is allowed; nothing was pressed.
        UserError: the keys don't go four ways, or the floor isn't free.
        NotConfirmedError: what was seen fits no walk; the keys are up.
        NotInFrontError, UnreadableError: the game isn't in front, or its debug screen can't be read.
    """
    connection = context.connection.for_profile(profile)
    context.say("Measuring how you walk, for about a minute: leave mouse and keys alone.")
    wait_until_standing_still(connection)
    connection.check_single_player()
    console = CommandConsole(connection, profile)
    _, began, _ = PoseReader(connection, profile.body.patience_s).read()
    can_teleport = profile.arena is not None and profile.world is None
    if profile.arena is not None and can_teleport:
        console.send(clear_command(profile.arena))
        for command in floor_commands(profile.arena, profile.game.dialect):
            console.send(command)
        console.send(teleport_command(profile.arena, profile.arena.middle, profile.body.pitch))
        middle = WorldPose(profile.arena.centre_of(profile.arena.middle), profile.arena.yaw, profile.body.pitch)
        _wait_for_arrival(connection, profile, middle)
    survey = Survey(Walker(connection, profile), profile.keys, context.devices.clock)
    try:
        is_floor_free = can_teleport and profile.arena is not None and profile.arena.floor is not None
        result = _measure(profile, survey, is_floor_free=is_floor_free, walks_back=not can_teleport)
    except (NotConfirmedError, UnreadableError, UserError):
        # Whoever calibrates again finds the player where the step began. Why it failed is what counts.
        with suppress(McNestedError):
            if can_teleport:
                console.send(_back_to(began))
        raise
    if can_teleport:
        console.send(_back_to(began))
        _wait_for_arrival(connection, profile, began)
    return result


def _measure(profile: Profile, survey: Survey, *, is_floor_free: bool, walks_back: bool) -> StepResult:
    """Measure, and return what fits the survey. Where the floor isn't known to be free, it is found by sneaking."""
    keys = survey.find_keys()
    if is_floor_free:
        survey.sneak_on_known_floor()
    else:
        survey.find_floor()
    survey.walk()
    try:
        walk_model = fit_walk_model(survey.holds)
    except NotConfirmedError:
        found = empirical_walk(survey.holds, WalkTable())
        if found is None:
            raise
        if walks_back:
            _walk_back(found.table.covered, survey)
        return _empirical_result(profile, keys, found)
    errors = _predict(walk_model, survey)
    walk_model = fit_walk_model(survey.holds)
    if walks_back:
        _walk_back(walk_model.table.covered, survey, _between_ticks(walk_model))
    lines = (
        f"Keys: {describe_keys(profile.keys, keys)}.",
        *_words(walk_model),
        _timed_words(errors),
        *_warnings(walk_model, profile),
    )
    return StepResult(
        "walk",
        profile.model_copy(update={"keys": keys, "walk": walk_model.table}),
        lines,
        len(walk_model.good),
        (picture_of_walk(walk_model),),
    )


def _empirical_result(profile: Profile, keys: KeysTable, found: EmpiricalWalk) -> StepResult:
    """Return what a walk without ticks gives, with a warning."""
    return StepResult(
        "walk",
        profile.model_copy(update={"keys": keys, "walk": found.table}),
        (
            f"Keys: {describe_keys(profile.keys, keys)}.",
            f"Walking {found.speed:.3f} blocks a second, sneaking {found.sneaking_speed:.3f}.",
            f"{len(found.traces)} holds ended {found.error:.4f} blocks (RMS) from a straight line.",
            WITHOUT_TICKS,
        ),
        len(found.traces),
        (picture_of_empirical_walk(found),),
    )


def _predict(walk_model: WalkModel, survey: Survey) -> list[float | None]:
    """Return each timed hold's prediction error, in blocks; None if it wasn't felt for as many ticks as asked."""
    phase = _between_ticks(walk_model)
    errors: list[float | None] = []
    for index, ticks in enumerate(TIMED):
        trace = survey.hold_homewards((FORWARD_AXIS, SIDE_AXIS)[index // 2 % 2], ticks, phase).trace
        error = (trace.covered[-1] if trace else 0.0) - walk_model.walking.covered(ticks)
        errors.append(error if abs(error) < walk_model.walking.steady / 2 else None)
    return errors


def _between_ticks(walk_model: WalkModel) -> float:
    """Return a time at which a press is felt between two ticks; others are whole ticks from there."""
    return walk_model.tick_phase - walk_model.round_trip_s + TICK_S / 2


def _walk_back(covered: Sequence[float], survey: Survey, phase: float | None = None) -> None:
    for axis in (FORWARD_AXIS, SIDE_AXIS):
        for _ in range(MAX_HOLDS_BACK):
            offset = abs(survey.offset(axis))
            if offset <= NEAR:
                break
            survey.hold_homewards(axis, max(1, nearest_ticks(offset, covered)), phase)


def _back_to(pose: WorldPose) -> str:
    x, y, z = pose.xyz
    return f"/tp @s {x:.3f} {y:.3f} {z:.3f} {pose.yaw:.1f} {pose.pitch:.1f}"


def _wait_for_arrival(connection: GameConnection, profile: Profile, pose: WorldPose) -> None:
    """Wait until the player is at a pose after a teleport; NotConfirmedError if that isn't seen within the patience."""

    def has_arrived(seen: PoseEstimate) -> bool:
        return seen.problem is None and max(map(abs, seen.position)) <= ARRIVAL_TOLERANCE

    observer = PoseObserver(profile, connection, PoseFrame.around(pose))
    if not has_arrived(observer.watch(has_arrived, profile.body.patience_s)):
        x, y, z = pose.xyz
        raise NotConfirmedError(
            f"the teleport to {x:g} {y:g} {z:g} was not seen: are cheats on, and is this the world of the arena?"
        )


def _words(walk_model: WalkModel) -> list[str]:
    steady, inertia = walk_model.walking.steady, walk_model.walking.inertia
    ticks = nearest_ticks(1.0, walk_model.table.covered)
    speeds = f"walking {walk_model.speed:.3f} blocks a second, sneaking {walk_model.sneaking.steady / TICK_S:.3f}"
    fits = f"{len(walk_model.good)} holds ended {walk_model.fit_rms:.4f} blocks (RMS) from where they should"
    cell = f"One cell is {ticks} ticks, {walk_model.table.covered[ticks - 1]:.3f} blocks"
    return [
        f"{speeds.capitalize()}; a tick leaves {inertia:.3f} of a step.",
        f"{fits}, those held out of the fit {walk_model.held_out_rms:.4f}.",
        f"{cell}; the nearest hold ends within {steady / 2:.3f} of a cell's middle, {steady / 4:.3f} on average.",
        f"From a press to its step on the screen: {walk_model.round_trip_s * 1000:.0f} ms, and up to a tick more.",
    ]


def _timed_words(errors: list[float | None]) -> str:
    as_asked = [error for error in errors if error is not None]
    ended = f", and ended {rms(as_asked):.4f} blocks (RMS) from where that was predicted" if as_asked else ""
    return f"Timed between two ticks, {len(as_asked)} of {len(errors)} holds were felt as long as asked{ended}."


def _warnings(walk_model: WalkModel, profile: Profile) -> list[str]:
    lines = []
    if walk_model.is_lagging:
        lines.append(
            f"Warning: the game lags: ticks came late in {walk_model.late} holds, and "
            f"{walk_model.outliers} were of no use. Close other programs, or lower the render distance."
        )
    if not walk_model.is_plain:
        lines.append(
            f"Warning: a plain walker makes {PLAIN_SPEED:.3f} blocks a second, with 0.546 left of a step. An effect or "
            "another floor? The profile holds for as long as it lasts: /effect clear @s, and calibrate again."
        )
    if walk_model.walking.steady / 2 > profile.body.tolerance:
        lines.append(
            "Warning: walking steps are too long to end within the tolerance of a cell's middle; many moves will sneak."
        )
    return lines
