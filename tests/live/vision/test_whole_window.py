"""Whether a picture is of the game's window alone: its debug screen fills the width from the upper left corner on."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.whole_window import shows_more_than_window
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.font import drawn_atlas
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS

FONT = font_of(drawn_atlas())
WIDTH, HEIGHT = 854, 480
TITLE_BAR, DESKTOP = 230, 90


def window(layout: Layout, scale: int = 2) -> Frame:
    screen = F3Screen(layout, scale, (8.5, 64.0, -3.25), 0.0, -65.0)
    return paint(np.full((HEIGHT, WIDTH, 3), 60, np.uint8), screen, FONT)


def on_desktop(frame: Frame, left: int, top: int, right: int, below: int) -> Frame:
    """The window with so many pixels of the desktop around it, and a title bar above it if there is room."""
    desktop = np.full((HEIGHT + top + below, WIDTH + left + right, 3), DESKTOP, np.uint8)
    desktop[max(0, top - 25) : top, left : left + WIDTH] = TITLE_BAR
    desktop[top : top + HEIGHT, left : left + WIDTH] = frame
    return desktop


def shows_more(frame: Frame) -> bool:
    found = find_debug_screen(frame, FONT)
    assert found is not None
    return shows_more_than_window(found, FONT)


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("scale", [1, 2])
def test_a_window_alone_is_one(layout: Layout, scale: int) -> None:
    assert not shows_more(window(layout, scale))


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("around", [(100, 62, 300, 200), (0, 25, 0, 0), (100, 0, 0, 0)])
def test_a_window_with_its_title_bar_or_the_desktop_is_none(layout: Layout, around: tuple[int, int, int, int]) -> None:
    assert shows_more(on_desktop(window(layout), *around))


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if layout not in ("standin", "26.4")])
def test_a_window_in_the_desktops_corner_is_none(layout: Layout) -> None:
    desktop = on_desktop(window(layout), 0, 0, 300, 100)
    assert str(read_debug_screen(desktop, FONT).problem).startswith("a notice may lie over")
    assert shows_more(desktop)
