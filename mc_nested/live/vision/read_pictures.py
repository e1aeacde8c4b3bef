"""Readings of picture files, as ``mc-nested read`` prints them.

A picture may show more than the game's window, as one of the whole desktop does. In a window's own, the first line
stands in the upper left corner, and the lines of the right column end at the right side (FACTS: The F3 debug screen;
The stand-in).
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from mc_nested.errors import PictureError
from mc_nested.live.model.reading import XYZ, Reading, Target
from mc_nested.live.vision.debug_screen import nothing_seen, read_found
from mc_nested.live.vision.fact_lines import fact_from
from mc_nested.live.vision.font import Font, decoded
from mc_nested.live.vision.glyph_grid import GridPosition
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.overlay import FoundScreen, find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.text_lines import UNKNOWN, is_text

_CORNERS = {"vanilla": ((2, 2),), "boxes": ((2, 3), (2, 6)), "stand-in": ((1, 1),)}
"""Row and column of the first line's first dot by the layout; of boxes, a line's and a title's."""

_ON_THE_RIGHT = "Java: "
"""How the right column begins in every version of the game."""


def shows_more_than_window(found: FoundScreen, font: Font) -> bool:
    """Return whether the debug screen found there stands elsewhere than in its window's corner, or is narrower."""
    lines = ScreenLines(found.dots, font, found.overlay)
    if not any(_begins(found, font, corner) for corner in _CORNERS[lines.layout.name]):
        return True
    has_right_side = lines.layout.name == "vanilla" and lines.holds(_ON_THE_RIGHT)
    return has_right_side and not lines.right_column()


def _begins(found: FoundScreen, font: Font, corner: GridPosition) -> bool:
    if not found.overlay.layout.has_facts:
        return is_text(found.dots, font, found.overlay, corner)
    text = fact_from(found.dots, font, found.overlay, corner).text
    return len(text) > 2 and UNKNOWN not in text[:3]


_JPEG = b"\xff\xd8\xff"
"""How every JPEG file begins."""

_ALONE = "and the picture has to be of the game's window alone, as F2 takes it"
_MORE = "the picture shows more than the game's window: cut off the window's frame and the desktop, or take it with F2"


@dataclass(frozen=True)
class PictureReading:
    """The values read from a picture file, each with its meaning; None where it isn't there."""

    file: Annotated[Path, "the picture"]
    xyz: Annotated[XYZ | None, "position of the feet"]
    yaw: Annotated[float | None, "degrees"]
    pitch: Annotated[float | None, "degrees"]
    target: Annotated[Target | None, "id and pos of the block that is looked at"]
    problem: Annotated[str | None, "why it can't be read"]


def read_picture(path: Path, font: Font, overlay: Overlay | None = None) -> PictureReading:
    """Return a picture file's reading.

    Without ``overlay`` the GUI scale, the colour and the layout are found. Raise PictureError for a file that is no
    picture.
    """
    reading = _read(path, font, overlay)
    return PictureReading(path, reading.xyz, reading.yaw, reading.pitch, reading.target, reading.problem)


def _read(path: Path, font: Font, overlay: Overlay | None) -> Reading:
    try:
        data = path.read_bytes()
    except OSError as error:
        raise PictureError(
            f"{path} can't be read ({error.strerror or error}): give a picture of the game's window"
        ) from error
    try:
        picture = decoded(data)
    except PictureError as error:
        raise PictureError(f"{path} {error}: give a PNG of the game's window, as F2 takes it") from None
    found = find_debug_screen(picture, font, overlay)
    if found is None:
        reading = Reading(problem=f"{nothing_seen(overlay).problem}; {_ALONE}")
    else:
        reading = read_found(found, font)
        is_blurred = data.startswith(_JPEG)
        if reading.problem is not None and not is_blurred and shows_more_than_window(found, font):
            reading = Reading(problem=_MORE)  # whatever else is said of it would mislead
    if reading.problem is not None and data.startswith(_JPEG):
        return Reading(
            problem=f"a JPEG blurs the text: give a PNG of the game's window, as F2 takes it; {reading.problem}"
        )
    return reading
