"""The reader checked against the game itself: F3+C copies where the player stands and looks (FACTS: Keys).

The keys are tapped, never held: after ten seconds the game would crash itself, as it is meant to. What was on the
clipboard is put back, whatever happens.
"""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from calibration.step import Bench, Found
from mc_nested.errors import LiveError, NotConfirmedError, UnreadableError
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.coordinates import turn_between
from mc_nested.live.devices import Clipboard
from mc_nested.live.fingerprint import game_in
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Reading
from mc_nested.live.session import overlay_of
from mc_nested.live.walk import TICK_S
from mc_nested.live.way_back import WayBack

STEP = "cross-check"

COPY = "c"
"""The letter beside the debug key; up to 1.21.10 neither can be another one (FACTS: Keys)."""

TAP_S = 1.5 * TICK_S
"""How long both keys are down: a tick falls into it, and it ends within two."""

TRIES = 3

PATIENCE_S = 1.5
"""How long the copy may take to be on the clipboard."""

LOOK_S = 0.1

OFF_BLOCKS = 0.005 + 0.0005
OFF_DEGREES = 0.05 + 0.005
"""How far the same value may be off: F3+C gives two decimals, the screen three of a place and one of an angle."""

_NUMBER = r"(-?\d+(?:\.\d+)?)"
_COPIED = re.compile(r"/execute in \S+ run tp @s " + " ".join([_NUMBER] * 5))
_MARK = "mc-nested: F3+C comes here"


def cross_check(bench: Bench, profile: Profile) -> Found:
    """Compare what the reader reads with what F3+C copies. Nothing of the profile changes.

    In a version before 1.13, which has no F3+C, nothing is compared, and that is said.

    Raises:
        ClipboardError: the clipboard can't be reached, or holds what could not be put back.
        UnreadableError: the two differ, or the debug screen can't be read.
        NotConfirmedError: nothing was copied.
        LiveError: the player was moved meanwhile; what the hands raise.
    """
    game = game_in(bench.desktop.display.title(), profile.game)
    if game.dialect == "1.12":
        return Found(STEP, profile, (f"F3+C is not in Minecraft {game.version}, it came with 1.13: not compared",), 0)
    desktop = bench.desktop
    screen = WindowScreen(desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    reading = read_at_rest(desktop.display, desktop.clock, screen.read)
    with _put_back(desktop.clipboard):
        copied = _copied(bench, profile, screen)
    if screen.read() != reading:
        raise LiveError("the player was moved while F3+C was pressed: stand still, and run this again")
    place, view = _differences(reading, copied)
    if place > OFF_BLOCKS or view > OFF_DEGREES:
        raise UnreadableError(
            f"the screen reads {_shown(reading)}, but F3+C says {copied}: is this the running game's own font? "
            "Name its jar: mc-nested calibrate font --font"
        )
    line = f"F3+C agrees with the reading: {_shown(reading)}, off by {place:.4f} blocks and {view:.3f} degrees at most"
    return Found(STEP, profile, (line,), 1)


@contextmanager
def _put_back(clipboard: Clipboard) -> Iterator[None]:
    """What is on the clipboard is there again when the block is left, unless somebody else copied something."""
    before = clipboard.read()
    try:
        clipboard.write(_MARK)
        yield
    finally:
        if clipboard.read() == _MARK or _COPIED.fullmatch(clipboard.read()):
            clipboard.write(before)


def _copied(bench: Bench, profile: Profile, screen: WindowScreen) -> tuple[float, ...]:
    """x, y, z, yaw and pitch as F3+C copies them."""
    hands, clock, clipboard, debug = bench.hands, bench.desktop.clock, bench.desktop.clipboard, profile.keys.debug
    way = WayBack(profile, hands, screen, bench.desktop.display, clock)
    for _ in range(TRIES):
        way.find()  # a letter that was lost has left F3 alone, which switches the debug screen off
        hands.saw("world")
        until = clock.now() + TAP_S
        hands.press(until, debug, COPY)
        hands.wait_until(until)
        # A release may have been lost on its way: held on, these two would end the game.
        hands.release_again()
        end = clock.now() + PATIENCE_S
        while clock.now() < end:
            hands.wait(LOOK_S)
            if found := _COPIED.fullmatch(clipboard.read()):
                return tuple(float(part) for part in found.groups())
    way.find()  # a game that doesn't know these keys has taken F3 for itself
    raise NotConfirmedError(
        "F3+C copied nothing: leave mouse and keys alone, switch the gamerule reducedDebugInfo off, and from 1.21.11 "
        f"on leave the debug modifier on {debug} and copying on {COPY}"
    )


def _differences(reading: Reading, copied: tuple[float, ...]) -> tuple[float, float]:
    """The largest difference in blocks, and in degrees."""
    if reading.xyz is None or reading.yaw is None or reading.pitch is None:
        raise UnreadableError("the debug screen shows no place: turn the whole of it on (F3)")
    x, y, z, yaw, pitch = copied
    place = max(abs(read - said) for read, said in zip(reading.xyz, (x, y, z), strict=True))
    return place, max(turn_between(reading.yaw, yaw), abs(reading.pitch - pitch))


def _shown(reading: Reading) -> str:
    x, y, z = reading.xyz or (0.0, 0.0, 0.0)
    return f"{x:.3f} {y:.3f} {z:.3f}, yaw {reading.yaw}, pitch {reading.pitch}"
