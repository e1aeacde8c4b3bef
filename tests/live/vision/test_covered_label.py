"""A label below grounds and letters: known by what shows, and by nothing like it.

The words of a pause without a menu.
"""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.covered_label import CoveredLabels, pause_region, shows_pause
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
    """Return the row of the label's middle, and whether it can be pressed."""
    covered = CoveredLabels(GlyphGrid(frame, SCALE, 150)).find(FONT.columns(label)[:-1])
    return (covered.middle[1], covered.is_enabled) if covered else None


@pytest.mark.parametrize("colour", [WHITE, GREY])
@pytest.mark.parametrize("grounds", [(), (80,), (48,), (80, 80)])
def test_a_label_is_found_under_any_ground_with_its_enabled_or_greyed_colour(
    grounds: tuple[int, ...], colour: Colour
) -> None:
    frame = button(colour=colour)
    for grey in grounds:
        below(frame, grey)
    assert found(frame) == (TOP + 10, colour == WHITE)


def test_a_label_is_found_under_letters_and_across_two_grounds() -> None:
    frame = button()
    below(frame, 80, right=230)
    below(frame, 80, left=200)
    write(frame, "[F3+3] Ping hidden", LEFT + 10)
    write(frame, "AMD Radeon", 235)
    assert found(frame) == (TOP + 10, True)


@pytest.mark.parametrize("shown", ["Disconnect", "Back to Game", "Respawn", "Save and Exit to Titles", ""])
def test_save_and_quit_is_not_found_on_a_covered_button_with_another_label(shown: str) -> None:
    frame = button(shown)
    below(frame, 80, right=214)
    write(frame, "[F3+3] Ping hidden", LEFT + 10)
    assert found(frame) is None


@pytest.mark.parametrize("label", ["Disconnect", "Respawn", "Back to Game"])
def test_no_other_label_is_found_on_a_covered_save_and_quit_button(label: str) -> None:
    frame = button()
    below(frame, 80, right=214)
    write(frame, "Display: 854x480 (AMD)", LEFT + 60)
    assert found(frame, label) is None


@pytest.mark.parametrize("label", ["Disconnect", "Respawn", "Back to Game"])
@pytest.mark.parametrize("shown", ["Game Paused", LABEL])
def test_no_label_is_found_on_a_ground_as_bright_as_letters(shown: str, label: str) -> None:
    frame = np.full((480, 854, 3), 240, np.uint8)
    MenuPainter(frame, SCALE, FONT, np.random.default_rng(0)).text(shown, 213 - len(FONT.columns(shown)) // 2, TOP)
    assert found(frame, label) is None


def test_a_label_almost_wholly_hidden_by_letters_is_not_found() -> None:
    frame = button()
    frame[SCALE * TOP : SCALE * (TOP + 20), SCALE * 150 : SCALE * 270] = 224
    assert found(frame) is None


@pytest.mark.parametrize("shape", [(0, 0), (10, 10), (7, 900), (300, 60)])
def test_no_label_is_found_in_a_frame_too_small_for_it(shape: tuple[int, int]) -> None:
    assert found(np.full((*shape, 3), 156, np.uint8)) is None


WORDS_TOP = 1
"""The words' first row in their region."""


def picture(words: str, *, covered: int = 0, ground: int = 90, row: int = WORDS_TOP, aside: int = 0) -> Frame:
    """Return the words, with their shadow, in the middle of their region; so many of their columns covered by a box."""
    region = pause_region((854, 480), SCALE)
    dots = np.full((region.height // SCALE + 20, region.width // SCALE, 3), ground, np.uint8)
    columns = np.frombuffer(FONT.columns(words), np.uint8)
    ink = np.unpackbits(columns[np.newaxis], axis=0, bitorder="little") > 0
    left = (dots.shape[1] - len(columns)) // 2 + aside
    for shade, by in ((63, 1), (255, 0)):
        dots[10 + row + by : 18 + row + by, left + by : left + by + len(columns)][ink] = shade
    dots[10:, left : left + covered] = 109
    return np.repeat(np.repeat(dots[10:][: region.height // SCALE], SCALE, 0), SCALE, 1)


@pytest.mark.parametrize("ground", [0, 63, 90, 255])
@pytest.mark.parametrize("words", ["Game Paused", "Game paused"])
def test_game_paused_is_recognised_on_any_ground_even_partly_covered(words: str, ground: int) -> None:
    assert shows_pause(picture(words, ground=ground), SCALE, FONT)
    if ground != 63:
        covered = picture(words, covered=18, ground=ground)
        covered[(covered == 109).all(2)] = 224
        assert shows_pause(covered, SCALE, FONT)


@pytest.mark.parametrize("words", ["Spiel pausiert", "Jeu en pause", "Juego en pausa", "Gioco in pausa", "Pauza"])
@pytest.mark.parametrize("ground", [0, 90, 255])
def test_a_pause_is_recognised_in_other_languages(words: str, ground: int) -> None:
    assert shows_pause(picture(words, ground=ground), SCALE, FONT)


@pytest.mark.parametrize("row", [-7, -1, 3, 4])
def test_a_text_in_other_rows_such_as_a_bosss_name_is_not_taken_for_a_pause(row: int) -> None:
    assert not shows_pause(picture("Ender Dragon", row=row), SCALE, FONT)


def test_a_text_off_the_middle_is_not_taken_for_a_pause() -> None:
    assert not shows_pause(picture("Ender Dragon", aside=10), SCALE, FONT)


def test_a_text_without_a_shadow_is_not_taken_for_a_pause() -> None:
    frame = picture("Game Paused")
    frame[(frame == 63).all(2)] = 90
    assert not shows_pause(frame, SCALE, FONT)


@pytest.mark.parametrize("ground", [0, 63, 90, 255])
def test_a_ground_without_words_is_not_taken_for_a_pause(ground: int) -> None:
    assert not shows_pause(picture(" ", ground=ground), SCALE, FONT)
