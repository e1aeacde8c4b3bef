"""The checks of input: a step and back, a slot of the hotbar and back, the debug screen off and on, and the clipboard.

Each key's effect is looked for on the screen and undone. Keys are pressed only while the world is visible with nothing
over it. The debug screen's key comes last, and only where the others arrive: without it nothing more could be read. No
other key is down meanwhile, since F3 with a letter has other effects (FACTS: Keys). The clipboard's contents are
restored.
"""

from collections.abc import Callable

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.doctor.snapshot import WindowSnapshot
from calibration.doctor.tried_keys import SLOT_SHOWN_S, Step, TriedWindow, is_menu, is_slot_seen_to_change, moving_key
from mc_nested.errors import DesktopError, NotInFrontError, WrongScreenError
from mc_nested.live.devices import Clipboard, Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.profile.tables import KeysTable
from mc_nested.live.vision.overlay import POSITION, REDUCED

TRIES = 3
"""Presses to turn the debug screen on again: one may get lost."""

UNDONE = 0.05
"""A player this near to where it stood, in blocks, counts as back: less than a sneaking tick."""

_ROW = CheckName.INPUT

_KEYS_LOST = (
    "do the profile's [keys] say what the game does? An input method (IME) may take the keys: switch it off. "
    "On Windows, start this as the user that the game runs as"
)


def input_row(
    devices: Devices, controller: InputController, snapshot: Callable[[], WindowSnapshot], keys: KeysTable
) -> Check:
    """Press keys and check their effects; ``snapshot`` takes a snapshot of the window."""
    current = snapshot()
    if not current.is_in_front:
        return Check(_ROW, "skip", "another window is in front, so nothing is pressed")
    if not current.is_world:
        return Check(_ROW, "skip", "keys are only pressed where the debug screen is read, with nothing over it")
    try:
        return _try_keys(TriedWindow(devices, controller, snapshot), keys)
    except NotInFrontError:
        return Check(_ROW, "fail", "another window came to the front", "leave the game in front, run this again")
    except WrongScreenError:
        return Check(_ROW, "warn", "a menu opened meanwhile", "close it, leave the game alone, and run this again")
    except DesktopError as error:
        return check_from_message(_ROW, "fail", str(error))


def _try_keys(window: TriedWindow, keys: KeysTable) -> Check:
    step = moving_key(window, keys)
    if step is None:
        tried = f"{keys.forward}, {keys.back} and {keys.left} were pressed with {keys.sneak}"
        return Check(_ROW, "fail", f"{tried}, and the player stayed where it was", _KEYS_LOST)
    if not is_slot_seen_to_change(window, keys, max(SLOT_SHOWN_S, step.seen_s)):
        tried = f"{keys.hotbar[0]} and {keys.hotbar[1]} were pressed"
        remedy = "is the hotbar on the screen (F1)? Are keys.hotbar in the profile right?"
        return Check(_ROW, "warn", f"{tried}, and the hotbar's frame wasn't seen to move", remedy)
    return _try_debug_key(window, keys, step)


def _try_debug_key(window: TriedWindow, keys: KeysTable, step: Step) -> Check:
    clock, key = window.devices.clock, keys.debug
    window.world()
    pressed_at = clock.now()
    window.controller.tap(key)
    off = window.first(lambda seen: not _is_on(seen) or is_menu(seen))
    took = clock.now() - pressed_at
    if off is None:
        remedy = "is keys.debug in the profile right? On a Mac, F3 may want Fn"
        return Check(_ROW, "fail", f"{key} was pressed, and the debug screen stayed on", remedy)
    for _ in range(TRIES):
        window.world()
        window.controller.tap(key)
        if back := window.first(lambda seen: _is_on(seen) or is_menu(seen)):
            if is_menu(back):
                break
            seen = f"{step.key}, {keys.hotbar[0]}, {keys.hotbar[1]} and {key} pressed, and seen"
            return Check(_ROW, "pass", f"{seen}, {key} after {1000 * took:.0f} ms; {_undone(step)}")
    return Check(_ROW, "warn", f"{key} works, but the debug screen didn't come back", f"press {key.upper()}")


def _undone(step: Step) -> str:
    if step.off is None:
        return "whether the step was undone couldn't be read"
    return "all undone" if step.off <= UNDONE else f"undone but for {step.off:.2f} blocks of the step"


def _is_on(snapshot: WindowSnapshot) -> bool:
    """Return whether the debug screen is on: an entry set to Always is shown without it, too."""
    return snapshot.contents is not None and snapshot.contents.line in (POSITION, REDUCED)


PROBE = "mc-nested doctor"


def clipboard_row(clipboard: Clipboard | None) -> Check:
    """Try the clipboard out, and return its check; None if there is none."""
    row = CheckName.CLIPBOARD
    if clipboard is None:
        return Check(row, "skip", "not looked at")
    try:
        before = clipboard.read()
        try:
            clipboard.write(PROBE)
            read = clipboard.read()
        finally:
            clipboard.write(before)
        after = clipboard.read()
    except DesktopError as error:
        # Only the cross-check of the reader needs the clipboard: an agent plays without it.
        return check_from_message(row, "warn", str(error))
    if read != PROBE:
        return Check(row, "warn", "what is written isn't what is read", "close the program that keeps it")
    if after != before:
        return Check(row, "warn", "what it held could not be put back", "copy it again")
    return Check(row, "pass", "read and written; what it held is back")
