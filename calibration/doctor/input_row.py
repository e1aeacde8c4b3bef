"""The input's row: the debug screen's own key, pressed once, seen to turn it off, and pressed again.

Why that key, of all: it changes nothing in the world, no server hears of it, and its effect is the very thing that is
read. It is pressed only while the world is seen with nothing over it; should the game have gone on to another screen
by then, F3 does nothing in a menu, in the chat or after a death, and it types no letter. A movement key would move the
player, a number the hotbar, Esc opens the Game Menu in the world, and letters go into a chat that just opened. It is
tapped with no other key down, since F3 with a letter does things (FACTS: Keys).
"""

from collections.abc import Callable

from calibration.doctor.check import Check, told
from calibration.doctor.look import Look
from mc_nested.errors import DesktopError, NotInFrontError, WrongScreenError
from mc_nested.live.desktop import Desktop
from mc_nested.live.hands import Hands

EFFECT_S = 1.5
"""How long a press may take to be seen: a game's slow frames, and a desktop's slow pictures."""

LOOK_S = 0.05
TRIES = 3
"""Presses to turn the debug screen on again: one may get lost."""

_ROW = "input"


def input_row(desktop: Desktop, hands: Hands, look: Callable[[], Look], key: str) -> Check:
    """Press the key of the debug screen and see it work; ``look`` looks at the window."""
    seen = look()
    if not seen.is_in_front:
        return Check(_ROW, "skip", "another window is in front, so nothing is pressed")
    if not seen.is_world:
        return Check(_ROW, "skip", f"{key} is only pressed where the debug screen is read, with nothing over it")
    try:
        return _tried(desktop, hands, look, key)
    except (NotInFrontError, WrongScreenError):
        return Check(_ROW, "fail", "another window came to the front", "leave the game in front, run this again")
    except DesktopError as error:
        return told(_ROW, "fail", str(error))


def _tried(desktop: Desktop, hands: Hands, look: Callable[[], Look], key: str) -> Check:
    clock = desktop.clock
    pressed = clock.now()
    hands.saw("world")
    hands.tap(key)
    off = _seen(hands, look, clock.now, lambda seen: not _is_on(seen) or _is_menu(seen))
    took = clock.now() - pressed
    if off is None:
        return Check(
            _ROW,
            "fail",
            f"{key} was pressed, and the debug screen stayed on",
            "is keys.debug in the profile right? On Windows, start this as the user that the game runs as",
        )
    if _is_menu(off):
        return Check(_ROW, "warn", "a menu opened meanwhile", "close it, leave the game alone, and run this again")
    for _ in range(TRIES):
        hands.saw("world")
        hands.tap(key)
        if back := _seen(hands, look, clock.now, lambda seen: _is_on(seen) or _is_menu(seen)):
            if _is_menu(back):
                break
            return Check(_ROW, "pass", f"{key} pressed, and seen after {1000 * took:.0f} ms; pressed again, and undone")
    return Check(_ROW, "warn", f"{key} works, but the debug screen didn't come back", f"press {key.upper()}")


def _seen(
    hands: Hands, look: Callable[[], Look], now: Callable[[], float], is_so: Callable[[Look], bool]
) -> Look | None:
    """The first look that is so; None where none is in time. NotInFrontError where the window goes behind another."""
    until = now() + EFFECT_S
    while True:
        seen = look()
        hands.check_front()
        if is_so(seen):
            return seen
        if now() >= until:
            return None
        hands.wait(LOOK_S)


def _is_on(seen: Look) -> bool:
    return seen.shown is not None and seen.shown.line is not None


def _is_menu(seen: Look) -> bool:
    return seen.shown is not None and seen.shown.screen not in ("world", "unknown")
