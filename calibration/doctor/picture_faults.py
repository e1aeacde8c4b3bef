"""What is wrong with a picture in which nothing of the game can be read: black, or with colours that aren't the game's.

How such pictures look is known from reports alone (FACTS: Input and windows).
"""

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.text_colours import PLAIN

BLACK = 8
"""Levels, of 255, up to which a picture counts as black."""

LEVELS = (170, 140, 110, 80, 230)
"""Brightnesses at which text that the game draws at 221 or more is looked for: the ground behind it is darker."""

NOT_PICTURED = (
    "the window's picture is black: play in a window (F11), not in exclusive fullscreen; unlock the session, and keep "
    "a remote one in view"
)

FAINT = "text of the game's is seen, but too faint to be read"
BRIGHT = "text of the game's is seen, but on too bright a ground to be read"

WASHED_OUT = "switch HDR, a night light and colour filters off for this screen: they change what is pictured"


def picture_fault(frame: Frame, font: Font) -> str | None:
    """What is wrong with a frame (height, width, 3) that can't be read, a colon, and what to do; None if unknown."""
    if int(frame.max(initial=0)) <= BLACK:
        return NOT_PICTURED
    for level in LEVELS:
        lifted = np.where(frame >= level, np.uint8(PLAIN[0]), np.uint8(0))
        if find_debug_screen(lifted, font) is not None:
            return f"{FAINT if level < PLAIN[0] else BRIGHT}: {WASHED_OUT}"
    return None
