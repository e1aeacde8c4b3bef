"""The colours, scales and layouts in which the game writes on the screen.

A reader has to know this before it reads a line (FACTS: The F3 debug screen).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

Colour = tuple[int, int, int]
"""Red, green, blue."""

INK_SPREAD = 4
"""How far a channel of the ink may lie from the text's: 221 to 224 were seen for 224 (FACTS: The F3 debug screen)."""

PLAIN: Colour = (224, 224, 224)
"""The debug screen's text, what is typed into the chat, and the buttons' labels before 1.16."""

BOX_ALPHA = 0x90 / 255
"""How much of a box's grey is over the world: 0x90 of 0xFF (FACTS: The F3 debug screen)."""

BOX_GREY, TITLE_GREY = 80, 48
"""Of a box, and of a title's ground from 26.4 on, before the world shines through: 0x50 and 0x30."""

WHITE: Colour = (255, 255, 255)
GLUE: Colour = (208, 208, 208)
"""What stands between the values, which are white, of the debug screen from 26.4 on."""

PURE_GREEN: Colour = (0, 255, 0)
PURE_RED: Colour = (255, 0, 0)
GREY: Colour = (170, 170, 170)
AQUA: Colour = (85, 255, 255)
YELLOW: Colour = (255, 255, 85)
GREEN: Colour = (85, 255, 85)
LIGHT_PURPLE: Colour = (255, 85, 255)
GOLD: Colour = (255, 170, 0)
RED: Colour = (255, 85, 85)

UNDER_MOUSE: Colour = (255, 255, 160)
"""A button's label while the mouse is over it."""

DISABLED: Colour = (160, 160, 160)
"""The label of a button that can't be pressed now."""


LayoutName = Literal["vanilla", "boxes", "stand-in"]

LINE_PITCH = 9
"""Dots from one line of the game's text to the next, in the debug screen and in the chat."""


class Box(NamedTuple):
    """The half-transparent box behind a line: its grey, and how many columns it goes on behind the line's last ink."""

    grey: int
    behind: int


@dataclass(frozen=True)
class ScreenLayout:
    """The features that all debug screens of one kind of client share; lengths are in dots.

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

BOXES = replace(VANILLA, name="boxes", right_edge=5, has_facts=True)
"""The game's own from 26.4 on."""

STANDIN = ScreenLayout(
    name="stand-in",
    pitch=10,
    text_colour=WHITE,
    box=Box(grey=110, behind=1),
    has_one_grid=False,
    right_edge=None,
    has_target_column=True,
)
"""The stand-in's (FACTS: The stand-in)."""

LAYOUTS: Mapping[LayoutName, ScreenLayout] = {layout.name: layout for layout in (VANILLA, BOXES, STANDIN)}


@dataclass(frozen=True)
class Overlay:
    """The scale, layout and colour of one debug screen, which stay the same from frame to frame.

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


class Scales(NamedTuple):
    """``gui`` is that of menus, chat and hotbar, ``debug`` that of the debug screen's text, the same or smaller.

    Up to 26.2 they are always the same.
    """

    gui: int
    debug: int

    def __str__(self) -> str:
        return f"{self.gui}" if self.gui == self.debug else f"{self.gui}, debug screen {self.debug}"


def largest_gui_scale(size: tuple[int, int]) -> int:
    """Return the largest GUI scale that a window (width, height) in framebuffer pixels can hold."""
    return max(1, min(size[0] // 320, size[1] // 240))
