"""Places to click, recorded by hand: hover, press the hotkey."""

from collections.abc import Callable, Mapping

from calibration.clicks.shown import Point
from mc_nested.live.click_points import is_telling
from mc_nested.live.devices import Display, Pointer


def record(
    wanted: Mapping[str, str],
    display: Display,
    pointer: Pointer,
    next_key: Callable[[], str],
    *,
    skip: str,
    say: Callable[[str], None],
) -> list[Point]:
    """The wanted points, each recorded at the next key; those skipped are left out.

    ``wanted`` has each point's name and where it is found; ``next_key`` waits for the hotkey or ``skip``.
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


def _under_pointer(name: str, display: Display, pointer: Pointer, say: Callable[[str], None]) -> Point | None:
    if not display.is_in_front():
        say("another window is in front: click on the game, hover, and press the key again")
        return None
    (x, y), frame = pointer.position(), display.grab()
    height, width = frame.shape[:2]
    if not (0 <= x < width and 0 <= y < height):
        say("the mouse is outside the game's window: hover over the place, and press the key again")
        return None
    point = Point(name, (round(x / width, 4), round(y / height, 4)), frame)
    if not is_telling(point.click_point(largest_scale(width, height)).picture):
        say("nothing is drawn there to know the place by: hover over its label, and press the key again")
        return None
    return point


def largest_scale(width: int, height: int) -> int:
    """The GUI scale that the game takes by itself in a window of that size, where none was seen, up to 4."""
    return max(1, min(width // 320, height // 240, 4))
