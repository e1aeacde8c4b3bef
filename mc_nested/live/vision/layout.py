"""How a debug screen is laid out and drawn: what a reader has to know before it reads a line."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

from mc_nested.live.vision.text_colours import PLAIN, Colour

LayoutName = Literal["vanilla", "boxes", "stand-in"]

LINE_PITCH = 9
"""Dots from one line of the game's text to the next, in the debug screen and in the chat."""


class Box(NamedTuple):
    """The half-transparent box behind a line: its grey, and how many columns it goes on behind the line's last ink."""

    grey: int
    behind: int


@dataclass(frozen=True)
class ScreenLayout:
    """What all debug screens of one kind of client have in common; lengths are in dots.

    Attributes:
        name: as a profile names it.
        pitch: from one line to the next.
        text_colour: of the text, where a profile names no other.
        box: behind each line.
        has_one_grid: an empty line is as high as any other, so lines stand at each ``pitch``-th row of a screen.
        right_edge: columns from the last ink of the right column to the window's side; None where it is found
            from the first line of that column.
        has_target_column: the right column holds nothing but its first line and the block looked at.
        has_facts: lines are names with values in colours of their own, in boxes with titles.
    """

    name: LayoutName
    pitch: int
    text_colour: Colour
    box: Box
    has_one_grid: bool
    right_edge: int | None
    has_target_column: bool
    has_facts: bool = False


VANILLA = ScreenLayout(
    name="vanilla",
    pitch=LINE_PITCH,
    text_colour=PLAIN,
    box=Box(grey=80, behind=2),
    has_one_grid=True,
    right_edge=4,
    has_target_column=False,
)
"""The game's own, to 26.3 (FACTS: The F3 debug screen)."""

BOXES = ScreenLayout(
    name="boxes",
    pitch=LINE_PITCH,
    text_colour=PLAIN,
    box=Box(grey=80, behind=2),
    has_one_grid=True,
    right_edge=5,
    has_target_column=False,
    has_facts=True,
)
"""The game's own from 26.4 on."""


@dataclass(frozen=True)
class Overlay:
    """How one debug screen is drawn: what holds from frame to frame.

    ``scale`` is the GUI scale, framebuffer pixels a dot; ``colour`` the text's red, green and blue as seen (vanilla 224
    each, 221 to 224 seen; the stand-in 255).
    """

    scale: int
    layout: ScreenLayout
    colour: Colour

    @property
    def pitch(self) -> int:
        """Dots from one line to the next."""
        return self.layout.pitch
