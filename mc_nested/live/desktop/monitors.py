"""The desktop's monitors, as mss lists them."""

import mss
from mss.exception import ScreenShotError

from mc_nested.live.devices import DesktopArea


def monitors() -> tuple[DesktopArea, ...]:
    """Where each monitor is on the desktop; none where the system names none. It needs a display."""
    try:
        with mss.MSS() as shots:
            each_alone = shots.monitors[1:]  # the first is all of them together
    except ScreenShotError:
        return ()
    return tuple(DesktopArea(each["left"], each["top"], each["width"], each["height"]) for each in each_alone)
