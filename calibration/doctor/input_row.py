"""Check input: a step and back, a slot of the hotbar and back, the debug screen off and on, and the clipboard.

Each key's effect is looked for on the screen and undone. Keys are pressed only while the world is visible with nothing
over it. The debug screen's key comes last, and only where the others arrive: without it nothing more could be read. No
other key is down meanwhile, since F3 with a letter has other effects (FACTS: Keys). The clipboard's contents are
restored.

The step is short and sneaking, so that the player falls nowhere, and is taken back (FACTS: Sneaking). Which slot is
chosen isn't on the debug screen: the frame around it is seen to move (FACTS: Screens and their buttons).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.doctor.snapshot import WindowSnapshot
from mc_nested.errors import DesktopError, NotInFrontError, WrongScreenError
from mc_nested.live.devices import Clipboard, Deadline, Devices, Frame, Region
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.reading import XYZ
from mc_nested.live.model.timing import KEY_LOOK_S
from mc_nested.live.profile.tables import KeysTable
from mc_nested.live.vision.overlay import POSITION, REDUCED

EFFECT_S = 1.5
"""How long the effect of a press may take to be seen: a game's slow frames, and a desktop's slow pictures."""

STEP_TICKS = 3
"""How long a step's keys are held; at least one of a slow game's frames sees them down."""

LEAST_STEP = 0.01
"""The shortest move that counts as a step, in blocks: a sneaking tick covers six times as much."""

STILL_S = 0.2
"""Seconds between two looks that must show the same position."""

SLOT_SHOWN_S = 0.4
"""Seconds from the press of a slot's key until its frame is drawn and pictured, in a game of 10 frames a second without
lag. In a game that lags, it takes as long as a step took to be seen."""

SLOT, BAR = 20, (182, 22)
"""GUI pixels from slot to slot, and the hotbar's width and height."""

LEAST_CHANGE, LEAST_DOTS = 30, 40
"""How much a colour must change, of 255, and on how many GUI pixels of a slot: its frame has more than 100."""


@dataclass(frozen=True)
class TriedWindow:
    """The window in which keys are tried; ``snapshot`` takes a snapshot of it."""

    devices: Devices
    controller: InputController
    snapshot: Callable[[], WindowSnapshot]

    def world(self) -> WindowSnapshot:
        """Return a snapshot of the world, for which a press is permitted now; WrongScreenError where a menu is open."""
        current = self.snapshot()
        self.controller.check_front()
        if is_menu(current):
            raise WrongScreenError("a menu opened meanwhile")
        self.controller.confirm_screen("world")
        return current

    def first(self, is_so: Callable[[WindowSnapshot], bool]) -> WindowSnapshot | None:
        """Return the first snapshot for which ``is_so`` holds, or None. NotInFrontError if another is in front."""
        deadline = Deadline(self.devices.clock, EFFECT_S)
        while True:
            current = self.snapshot()
            self.controller.check_front()
            if is_so(current):
                return current
            if deadline.has_passed:
                return None
            self.controller.wait(KEY_LOOK_S)


def is_menu(snapshot: WindowSnapshot) -> bool:
    """Return whether a menu is seen."""
    return snapshot.contents is not None and snapshot.contents.screen not in ("world", "unknown")


@dataclass(frozen=True)
class TriedStep:
    """A step that was seen and taken back.

    ``key`` led there, which was seen ``seen_s`` seconds after it went down; the player ended ``off`` blocks from where
    it stood, None where that couldn't be read.
    """

    key: str
    seen_s: float
    off: float | None


def moving_key(window: TriedWindow, keys: KeysTable) -> TriedStep | None:
    """Return the step of the first movement key that was seen to move the player; None where none does."""
    for there, back in ((keys.forward, keys.back), (keys.back, keys.forward), (keys.left, keys.right)):
        start, pressed_at = window.world(), window.devices.clock.now()
        window.controller.hold(there, STEP_TICKS, keys.sneak)
        if window.first(partial(_has_moved_or_stopped, start)):
            seen_s = window.devices.clock.now() - pressed_at
            _stand_still(window)
            window.world()
            window.controller.hold(back, STEP_TICKS, keys.sneak)
            # In a game that lags the player is seen to stand before it is seen to go back.
            window.controller.wait(seen_s)
            return TriedStep(there, seen_s, _distance(_position(start), _stand_still(window)))
    return None


def is_slot_seen_to_change(window: TriedWindow, keys: KeysTable, shown_s: float = SLOT_SHOWN_S) -> bool:
    """Return whether the first two slots' keys move the frame from one to the other. The slot before is chosen again.

    ``shown_s`` is how long a press may take to be seen, in seconds.
    """
    contents = window.world().contents
    scale = contents.scales.gui if contents and contents.scales else 1
    before = _bar(window.devices, scale)
    window.controller.tap_alone(keys.hotbar[0])
    window.controller.wait(shown_s)
    first = _bar(window.devices, scale)
    window.world()
    window.controller.tap_alone(keys.hotbar[1])
    window.controller.wait(shown_s)
    second = _bar(window.devices, scale)
    window.world()
    window.controller.tap_alone(keys.hotbar[_slot_before(_changed_dots(before, first, scale))])
    changed = [dots >= LEAST_DOTS for dots in _changed_dots(first, second, scale)]
    return changed == [True, True, *[False] * 7]


def _slot_before(changed_dots: list[float]) -> int:
    """Return which slot's frame went to the first slot; the first, if none did."""
    most = max(range(1, 9), key=changed_dots.__getitem__)
    return most if changed_dots[most] >= LEAST_DOTS else 0


def _distance(before: XYZ | None, after: XYZ | None) -> float | None:
    """Return the blocks over ground from one position to another; None if one of them wasn't read."""
    if before is None or after is None:
        return None
    return math.hypot(after[0] - before[0], after[2] - before[2])


def _position(snapshot: WindowSnapshot) -> XYZ | None:
    return snapshot.contents.reading.xyz if snapshot.contents is not None else None


def _has_moved_or_stopped(start: WindowSnapshot, seen: WindowSnapshot) -> bool:
    return is_menu(seen) or (_distance(_position(start), _position(seen)) or 0.0) > LEAST_STEP


def _stand_still(window: TriedWindow) -> XYZ | None:
    """Wait until the player stands, or moves by no key of ours for EFFECT_S; return where it is then."""
    deadline, before = Deadline(window.devices.clock, EFFECT_S), _position(window.snapshot())
    window.controller.wait(STILL_S)
    while not deadline.has_passed:
        position = _position(window.snapshot())
        if position is not None and position == before:
            break
        before = position
        window.controller.wait(STILL_S)
    return before


def _bar(devices: Devices, scale: int) -> Frame:
    """Return the hotbar's place in the window, framebuffer pixels."""
    width, height = devices.display.size()
    gui_width, gui_height = -(-width // scale), -(-height // scale)
    left, top = (gui_width // 2 - BAR[0] // 2) * scale, (gui_height - BAR[1]) * scale
    picture: Frame = devices.display.grab(Region(left, top, BAR[0] * scale, BAR[1] * scale)).copy()
    return picture


def _changed_dots(before: Frame, after: Frame, scale: int) -> list[float]:
    """Return how many GUI pixels of each of the nine slots changed, without the outermost, which two slots share."""
    change = np.abs(before.astype(np.int16) - after).max(axis=2) > LEAST_CHANGE
    parts = (change[:, (SLOT * slot + 3) * scale : (SLOT * (slot + 1) - 1) * scale] for slot in range(9))
    return [int(part.sum()) / scale**2 for part in parts]


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


def _try_debug_key(window: TriedWindow, keys: KeysTable, step: TriedStep) -> Check:
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


def _undone(step: TriedStep) -> str:
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
