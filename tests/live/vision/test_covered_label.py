"""A label below grounds and letters: known by what shows, and by nothing like it."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.covered_label import CoveredLabels
from mc_nested.live.vision.glyph_grid import GlyphGrid
from tests.live.vision.menu_painter import GREY, WHITE, Colour, MenuPainter
from tests.sim.client.playing import FONT

LABEL = "Save and Quit to Title"
LEFT, TOP, WIDE = 112, 100, 204
SCALE = 2


def button(label: str = LABEL, colour: Colour = WHITE) -> Frame:
    frame = np.full((480, 854, 3), 30, np.uint8)
    MenuPainter(frame, SCALE, FONT, np.random.default_rng(0)).button(label, LEFT, TOP, WIDE, colour)
    return frame


def below(frame: Frame, grey: int, left: int = LEFT, right: int = LEFT + WIDE) -> None:
    """Lay a ground over the button, between two columns of GUI pixels."""
    part = frame[SCALE * (TOP - 4) : SCALE * (TOP + 24), SCALE * left : SCALE * right]
    part[:] = np.rint(part * (111 / 255) + grey * (144 / 255)).astype(np.uint8)


def write(frame: Frame, text: str, left: int, top: int = TOP + 6) -> None:
    """Write letters of the debug screen."""
    columns = np.frombuffer(FONT.columns(text), np.uint8)
    ink = np.unpackbits(columns[np.newaxis], axis=0, bitorder="little") > 0
    part = frame[SCALE * top : SCALE * (top + 8), SCALE * left : SCALE * (left + len(columns))]
    part[np.repeat(np.repeat(ink, SCALE, 0), SCALE, 1)] = 224


def found(frame: Frame, label: str = LABEL) -> tuple[int, bool] | None:
    """The row of the label's middle, and whether it can be pressed."""
    covered = CoveredLabels(GlyphGrid(frame, SCALE, 150)).find(FONT.columns(label)[:-1])
    return (covered.middle[1], covered.is_enabled) if covered else None


@pytest.mark.parametrize("colour", [WHITE, GREY])
@pytest.mark.parametrize("grounds", [(), (80,), (48,), (80, 80)])
def test_a_label_is_known_below_any_ground_and_whether_it_can_be_pressed(
    grounds: tuple[int, ...], colour: Colour
) -> None:
    frame = button(colour=colour)
    for grey in grounds:
        below(frame, grey)
    assert found(frame) == (TOP + 10, colour == WHITE)


def test_letters_over_it_and_two_grounds_that_meet_there_hide_it_not() -> None:
    frame = button()
    below(frame, 80, right=230)
    below(frame, 80, left=200)
    write(frame, "[F3+3] Ping hidden", LEFT + 10)
    write(frame, "AMD Radeon", 235)
    assert found(frame) == (TOP + 10, True)


@pytest.mark.parametrize("shown", ["Disconnect", "Back to Game", "Respawn", "Save and Exit to Titles", ""])
def test_another_label_there_is_not_taken_for_it(shown: str) -> None:
    frame = button(shown)
    below(frame, 80, right=214)
    write(frame, "[F3+3] Ping hidden", LEFT + 10)
    assert found(frame) is None


@pytest.mark.parametrize("label", ["Disconnect", "Respawn", "Back to Game"])
def test_nor_is_it_taken_for_another(label: str) -> None:
    frame = button()
    below(frame, 80, right=214)
    write(frame, "Display: 854x480 (AMD)", LEFT + 60)
    assert found(frame, label) is None


@pytest.mark.parametrize("label", ["Disconnect", "Respawn", "Back to Game"])
@pytest.mark.parametrize("shown", ["Game Paused", LABEL])
def test_nor_on_a_ground_as_bright_as_letters(shown: str, label: str) -> None:
    frame = np.full((480, 854, 3), 240, np.uint8)
    MenuPainter(frame, SCALE, FONT, np.random.default_rng(0)).text(shown, 213 - len(FONT.columns(shown)) // 2, TOP)
    assert found(frame, label) is None


def test_what_letters_hide_almost_wholly_is_not_known() -> None:
    frame = button()
    frame[SCALE * TOP : SCALE * (TOP + 20), SCALE * 150 : SCALE * 270] = 224
    assert found(frame) is None


@pytest.mark.parametrize("shape", [(0, 0), (10, 10), (7, 900), (300, 60)])
def test_a_frame_too_small_for_it_has_none(shape: tuple[int, int]) -> None:
    assert found(np.full((*shape, 3), 156, np.uint8)) is None
