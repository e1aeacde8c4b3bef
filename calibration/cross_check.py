"""Checks the reader against the game itself: F3+C copies the player's position and view (FACTS: Keys).

The keys are tapped, never held: after ten seconds the game would crash itself, on purpose. The clipboard's contents
are restored, whatever happens.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from calibration.context import CalibrationContext, StepResult
from mc_nested.errors import LiveError, NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Clipboard, Deadline
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.menus.wait_for_player import wait_until_standing_still
from mc_nested.live.model.coordinates import turn_between
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.timing import MENU_LOOK_S
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.tables import Profile

STEP = "cross-check"

COPY = "c"
"""The letter pressed with the debug key; up to 1.21.10 neither can be rebound (FACTS: Keys)."""

TAP_S = 1.5 * TICK_S
"""How long both keys are down: a tick falls into it, and it ends within two."""

TRIES = 3

PATIENCE_S = 1.5
"""How long the copy may take to reach the clipboard."""

TOLERANCE_BLOCKS = 0.005 + 0.0005
TOLERANCE_DEG = 0.05 + 0.005
"""Rounding: F3+C gives two decimals, the screen three of a coordinate and one of an angle."""

_NUMBER = r"(-?\d+(?:\.\d+)?)"
_COPIED = re.compile(r"/execute in \S+ run tp @s " + " ".join([_NUMBER] * 5))
_MARK = "mc-nested: F3+C comes here"


def cross_check(context: CalibrationContext, profile: Profile) -> StepResult:
    """Compare the reader's reading with what F3+C copies. The profile doesn't change.

    Versions before 1.13 have no F3+C: nothing is compared, and the result says so.

    Raises:
        ClipboardError: the clipboard can't be reached, or its contents could not be restored.
        UnreadableError: the two differ, or the debug screen can't be read.
        NotConfirmedError: nothing was copied.
        LiveError: the player was moved meanwhile; errors of the input controller.
    """
    game = game_in(context.devices.display.title(), profile.game)
    if game.dialect == "1.12":
        return StepResult(
            STEP, profile, (f"F3+C is not in Minecraft {game.version}, it came with 1.13: not compared",), 0
        )
    connection = context.connection.for_profile(profile)
    reading = wait_until_standing_still(connection)
    with _restored(connection.devices.clipboard):
        copied = _copied(connection, profile)
    if connection.screen.read() != reading:
        raise LiveError("the player was moved while F3+C was pressed: stand still, and run this again")
    blocks, degrees = _differences(reading, copied)
    if blocks > TOLERANCE_BLOCKS or degrees > TOLERANCE_DEG:
        raise UnreadableError(
            f"the screen reads {_pose_text(reading)}, but F3+C says {copied}: is this the running game's own font? "
            "Name its jar: mc-nested calibrate font --font"
        )
    off = f"off by {blocks:.4f} blocks and {degrees:.3f} degrees at most"
    line = f"F3+C agrees with the reading: {_pose_text(reading)}, {off}"
    return StepResult(STEP, profile, (line,), 1)


@contextmanager
def _restored(clipboard: Clipboard) -> Iterator[None]:
    """Restore the clipboard when the block is left, unless somebody else copied something meanwhile."""
    before = clipboard.read()
    try:
        clipboard.write(_MARK)
        yield
    finally:
        if clipboard.read() == _MARK or _COPIED.fullmatch(clipboard.read()):
            clipboard.write(before)


def _copied(connection: GameConnection, profile: Profile) -> tuple[float, ...]:
    """Return x, y, z, yaw and pitch as F3+C copies them."""
    controller, debug = connection.controller, profile.keys.debug
    clock, clipboard = connection.devices.clock, connection.devices.clipboard
    recovery = Recovery(profile, connection)
    for _ in range(TRIES):
        recovery.recover()  # if the letter was lost, F3 alone has switched the debug screen off
        controller.confirm_screen("world")
        controller.wait_until(controller.press(clock.now() + TAP_S, debug, COPY))
        # The release may have been lost: if these two keys stay down, the game crashes.
        controller.release_again()
        deadline = Deadline(clock, PATIENCE_S)
        while not deadline.has_passed:
            controller.wait(MENU_LOOK_S)
            if match := _COPIED.fullmatch(clipboard.read()):
                return tuple(float(part) for part in match.groups())
    recovery.recover()  # a game that doesn't know F3+C has taken F3 alone
    raise NotConfirmedError(
        "F3+C copied nothing: leave mouse and keys alone, switch the gamerule reducedDebugInfo off, and from 1.21.11 "
        f"on leave the debug modifier on {debug} and copying on {COPY}"
    )


def _differences(reading: Reading, copied: tuple[float, ...]) -> tuple[float, float]:
    """Return the largest difference in blocks, and in degrees."""
    if reading.xyz is None or reading.yaw is None or reading.pitch is None:
        raise UnreadableError("the debug screen shows no position: turn the whole of it on (F3)")
    x, y, z, yaw, pitch = copied
    blocks = max(abs(read - value) for read, value in zip(reading.xyz, (x, y, z), strict=True))
    return blocks, max(turn_between(reading.yaw, yaw), abs(reading.pitch - pitch))


def _pose_text(reading: Reading) -> str:
    x, y, z = reading.xyz or (0.0, 0.0, 0.0)
    return f"{x:.3f} {y:.3f} {z:.3f}, yaw {reading.yaw}, pitch {reading.pitch}"
