"""The words of a pause without a menu."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.pause_words import pause_region, shows_pause
from tests.sim.client.playing import FONT

SCALE = 2
TOP = 1
"""The words' first row in their region."""


def picture(words: str, *, covered: int = 0, ground: int = 90, row: int = TOP, aside: int = 0) -> Frame:
    """The words, with their shadow, in the middle of their region; so many of their columns covered by a box."""
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
def test_the_words_are_seen_on_any_ground_also_where_text_covers_a_part(words: str, ground: int) -> None:
    assert shows_pause(picture(words, ground=ground), SCALE, FONT)
    if ground != 63:
        covered = picture(words, covered=18, ground=ground)
        covered[(covered == 109).all(2)] = 224
        assert shows_pause(covered, SCALE, FONT)


@pytest.mark.parametrize("words", ["Spiel pausiert", "Jeu en pause", "Juego en pausa", "Gioco in pausa", "Pauza"])
@pytest.mark.parametrize("ground", [0, 90, 255])
def test_words_of_other_languages_there_are_a_pause_too(words: str, ground: int) -> None:
    assert shows_pause(picture(words, ground=ground), SCALE, FONT)


@pytest.mark.parametrize("row", [-7, -1, 3, 4])
def test_a_text_in_other_rows_is_none_as_a_bosss_name_or_a_line_of_the_chat(row: int) -> None:
    assert not shows_pause(picture("Ender Dragon", row=row), SCALE, FONT)


def test_a_text_beside_the_middle_is_none() -> None:
    assert not shows_pause(picture("Ender Dragon", aside=10), SCALE, FONT)


def test_a_text_without_a_shadow_is_none() -> None:
    frame = picture("Game Paused")
    frame[(frame == 63).all(2)] = 90
    assert not shows_pause(frame, SCALE, FONT)


@pytest.mark.parametrize("ground", [0, 63, 90, 255])
def test_a_ground_without_words_is_none(ground: int) -> None:
    assert not shows_pause(picture(" ", ground=ground), SCALE, FONT)
