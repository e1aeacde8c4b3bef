"""Waiting for a person: until the game is in front, its debug screen can be read, and the player stands still."""

import math
from collections.abc import Callable

from mc_nested.errors import NotInFrontError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import SWITCH_KEYS, Deadline, Devices
from mc_nested.live.menus.click_points import ClickPoints
from mc_nested.live.menus.screens import NO_HOTBAR, identify_screen
from mc_nested.live.model.debug_entries import GROUND_PITCH_DEG, why_none_is_named
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.timing import PERSON_LOOK_S

SAID_AFTER_S = 3.0
"""How long a person who has just switched to the game is left alone."""

HOTBAR_S = 3.0
"""How long the hotbar may be hidden by what has no name here, as by a picture that is black."""

PATIENCE_S = 60.0
"""How long the player has to switch to the game and turn the debug screen on."""


def wait_for_front(devices: Devices) -> None:
    """Return as soon as the game is in front; raise NotInFrontError where that takes too long."""
    clock = devices.clock
    deadline = Deadline(clock, PATIENCE_S)
    while not devices.display.is_in_front():
        if deadline.has_passed:
            raise _not_in_front()
        clock.sleep_until(clock.now() + PERSON_LOOK_S)


def wait_until_standing_still(connection: GameConnection, say: Callable[[str], None] = lambda _: None) -> Reading:
    """Return the first reading that is the same twice in a row while the game is in front.

    If the debug screen can't be read for SAID_AFTER_S meanwhile, ``say`` is told why.

    Raises:
        NotInFrontError: the game was not in front when time ran out.
        UnreadableError: it was, but the debug screen could not be read, or the player kept moving.
    """
    display, clock = connection.devices.display, connection.devices.clock
    deadline = Deadline(clock, PATIENCE_S)
    before: Reading | None = None
    problem: str | None = None
    unread_since: float | None = None
    connection.journal.note("waits", on="the game in front, its debug screen on, and the player standing still")
    while not deadline.has_passed:
        reading = connection.screen.read() if display.is_in_front() else None
        if reading is not None and reading.problem is None and reading == before:
            return reading
        before = reading
        problem = (reading.problem or "the player keeps moving") if reading else None
        if reading is not None and reading.problem is not None:
            unread_since = clock.now() if unread_since is None else unread_since
            if clock.now() - unread_since >= SAID_AFTER_S:
                say(f"Waiting up to {PATIENCE_S:.0f} s for the debug screen: {reading.problem}")
                unread_since = math.inf
        clock.sleep_until(clock.now() + PERSON_LOOK_S)
    if problem is None:
        raise _not_in_front()
    raise UnreadableError(f"the debug screen can't be read ({problem}): mend that, and run this again")


def check_hotbar(connection: GameConnection, points: ClickPoints) -> None:
    """Raise UnreadableError, of one line, where the hotbar isn't seen, and no screen that is known hides it.

    Called once the debug screen could be read. Nothing is pressed.
    """
    screen, devices = connection.screen, connection.devices
    deadline = Deadline(devices.clock, HOTBAR_S)
    while screen.seen_scales() is None and identify_screen(screen, devices.display, points)[0] == "menu":
        if deadline.has_passed:
            raise UnreadableError(NO_HOTBAR)
        devices.clock.sleep_until(devices.clock.now() + PERSON_LOOK_S)


def check_block_is_named(reading: Reading, version: str) -> None:
    """Raise UnreadableError, of one line, where the ground is looked at and the debug screen names no block.

    Where the player looks up, the first reset finds it.
    """
    looks_down = reading.pitch is not None and reading.pitch >= GROUND_PITCH_DEG
    if looks_down and (reason := why_none_is_named(reading, version)):
        raise UnreadableError(reason)


def _not_in_front() -> NotInFrontError:
    return NotInFrontError(
        f"the game's window didn't come to the front: "
        f"switch to it with {SWITCH_KEYS}, not by a click, and run this again"
    )
