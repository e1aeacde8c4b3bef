"""The input's check: press the debug screen's own key, see the debug screen go off, and press the key again.

Why that key: it changes nothing in the world, no server notices it, and its effect is exactly what is read. It is
pressed only while the world is visible with nothing over it. If the game has switched to another screen by then, F3
does nothing in a menu, in the chat or after a death, and types no letter. A movement key would move the player, a
number would change the hotbar, Esc opens the Game Menu in the world, and letters go into a chat that just opened. No
other key is down meanwhile, since F3 with a letter has other effects (FACTS: Keys).
"""

from collections.abc import Callable

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.doctor.snapshot import WindowSnapshot
from mc_nested.errors import DesktopError, NotInFrontError, WrongScreenError
from mc_nested.live.deadline import Deadline
from mc_nested.live.devices import Clock, Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.timing import KEY_LOOK_S

EFFECT_S = 1.5
"""How long the effect of a press may take to be seen: a game's slow frames, and a desktop's slow pictures."""

TRIES = 3
"""Presses to turn the debug screen on again: one may get lost."""

_ROW = CheckName.INPUT


def input_row(devices: Devices, controller: InputController, snapshot: Callable[[], WindowSnapshot], key: str) -> Check:
    """Press the key of the debug screen and check its effect; ``snapshot`` takes a snapshot of the window."""
    current = snapshot()
    if not current.is_in_front:
        return Check(_ROW, "skip", "another window is in front, so nothing is pressed")
    if not current.is_world:
        return Check(_ROW, "skip", f"{key} is only pressed where the debug screen is read, with nothing over it")
    try:
        return _try_key(devices, controller, snapshot, key)
    except (NotInFrontError, WrongScreenError):
        return Check(_ROW, "fail", "another window came to the front", "leave the game in front, run this again")
    except DesktopError as error:
        return check_from_message(_ROW, "fail", str(error))


def _try_key(devices: Devices, controller: InputController, snapshot: Callable[[], WindowSnapshot], key: str) -> Check:
    clock = devices.clock
    pressed_at = clock.now()
    controller.confirm_screen("world")
    controller.tap(key)
    off = _first_snapshot(controller, clock, snapshot, lambda seen: not _is_on(seen) or _is_menu(seen))
    took = clock.now() - pressed_at
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
        controller.confirm_screen("world")
        controller.tap(key)
        if back := _first_snapshot(controller, clock, snapshot, lambda seen: _is_on(seen) or _is_menu(seen)):
            if _is_menu(back):
                break
            return Check(_ROW, "pass", f"{key} pressed, and seen after {1000 * took:.0f} ms; pressed again, and undone")
    return Check(_ROW, "warn", f"{key} works, but the debug screen didn't come back", f"press {key.upper()}")


def _first_snapshot(
    controller: InputController,
    clock: Clock,
    snapshot: Callable[[], WindowSnapshot],
    is_so: Callable[[WindowSnapshot], bool],
) -> WindowSnapshot | None:
    """The first snapshot for which ``is_so`` holds, or None. NotInFrontError if the window loses the front."""
    deadline = Deadline(clock, EFFECT_S)
    while True:
        current = snapshot()
        controller.check_front()
        if is_so(current):
            return current
        if deadline.has_passed:
            return None
        controller.wait(KEY_LOOK_S)


def _is_on(snapshot: WindowSnapshot) -> bool:
    return snapshot.contents is not None and snapshot.contents.line is not None


def _is_menu(snapshot: WindowSnapshot) -> bool:
    return snapshot.contents is not None and snapshot.contents.screen not in ("world", "unknown")
