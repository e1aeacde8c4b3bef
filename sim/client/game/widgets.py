"""The parts of a screen: texts and their colours, buttons, panels. Positions and sizes are in GUI pixels."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

from sim.client.game.debug_entries import Status

Colour = tuple[int, int, int]

WHITE: Colour = (255, 255, 255)
GREY: Colour = (160, 160, 160)
PLAIN: Colour = (224, 224, 224)
DRAFT: Colour = (170, 170, 170)
RED: Colour = (255, 85, 85)

TEXT: Colour = (224, 224, 224)
"""The debug screen's text."""
GLUE: Colour = (208, 208, 208)
"""What stands between the values of 26.4's debug screen, which are white."""


Effect = Literal[
    "",
    "resume",
    "leave",
    "respawn",
    "to_title",
    "to_worlds",
    "to_servers",
    "select_world",
    "enter_world",
    "enter_selected",
    "behind",
    "default_profile",
    "performance_profile",
]
"""What a click does: nothing for buttons that no test needs."""


class EntryChange(NamedTuple):
    """The effect of a button of the debug options: show an entry always, with F3, or never."""

    entry: str
    status: Status


@dataclass(frozen=True)
class Widget:
    """A button, or a part of the screen that can be clicked and isn't drawn.

    Without a label it has a picture. Its label's colour is its version's, unless ``colour`` says otherwise.
    """

    label: str
    left: int
    top: int
    width: int
    does: Effect | EntryChange = ""
    height: int = 20
    is_active: bool = True
    is_drawn: bool = True
    colour: Colour | None = None

    def contains(self, x: float, y: float) -> bool:
        """Return whether a position in GUI pixels lies on it."""
        return self.left <= x < self.left + self.width and self.top <= y < self.top + self.height

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle, in GUI pixels."""
        return self.left + self.width / 2, self.top + self.height / 2


@dataclass(frozen=True)
class MenuText:
    """A text with a shadow; ``left`` is its middle where it is centred, and ``size`` 2 a large title."""

    text: str
    left: int
    top: int
    colour: Colour = WHITE
    is_centred: bool = True
    size: int = 1


class MenuPanel(NamedTuple):
    """A dark rectangle behind texts and buttons; its alpha is out of 255."""

    left: int
    top: int
    width: int
    height: int
    alpha: int = 255


@dataclass(frozen=True)
class Menu:
    """A screen's texts and buttons, in front of its panels. Of two buttons at a place, the first is clicked."""

    texts: tuple[MenuText, ...] = ()
    buttons: tuple[Widget, ...] = ()
    panels: tuple[MenuPanel, ...] = ()
