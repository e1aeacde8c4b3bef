"""Records click points by hand: the player hovers over each and presses a hotkey."""

from collections.abc import Callable, Mapping

from calibration.clicks.recorded_point import RecordedPoint
from mc_nested.live.devices import SWITCH_KEYS, Display, Pointer
from mc_nested.live.menus.click_points import has_pattern


def record_by_hand(
    wanted: Mapping[str, str],
    display: Display,
    pointer: Pointer,
    next_key: Callable[[], str],
    *,
    skip: str,
    say: Callable[[str], None],
) -> list[RecordedPoint]:
    """The wanted points, each recorded at the next hotkey; skipped ones are left out.

    ``wanted`` maps each point's name to a description of where it is. ``next_key`` waits for the hotkey or ``skip``.
    """
    points = []
    for name, where in wanted.items():
        say(f"{name}: {where}")
        point = None
        while point is None and next_key() != skip:
            point = _under_pointer(name, display, pointer, say)
        if point is not None:
            points.append(point)
    return points


def _under_pointer(name: str, display: Display, pointer: Pointer, say: Callable[[str], None]) -> RecordedPoint | None:
    if not display.is_in_front():
        say(f"another window is in front: switch to the game with {SWITCH_KEYS}, hover, and press the key again")
        return None
    (x, y), frame = pointer.position(), display.grab()
    height, width = frame.shape[:2]
    if not (0 <= x < width and 0 <= y < height):
        say("the mouse is outside the game's window: hover over the button, and press the key again")
        return None
    point = RecordedPoint(name, (round(x / width, 4), round(y / height, 4)), frame)
    if not has_pattern(point.click_point(largest_scale(width, height)).picture):
        say("nothing is drawn there to recognize it by: hover over its label, and press the key again")
        return None
    return point


def largest_scale(width: int, height: int) -> int:
    """The GUI scale, up to 4, that the game picks by default in a window of that size."""
    return max(1, min(width // 320, height // 240, 4))
