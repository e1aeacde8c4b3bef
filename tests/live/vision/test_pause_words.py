"""The words of a pause without a menu."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.pause_words import pause_region, shows_pause
from tests.sim.client.playing import FONT


def picture(words: str, *, covered: int = 0, ground: int = 90) -> Frame:
    """The words in the middle of their region at GUI scale 2, so many of its columns covered by a box."""
    region = pause_region((854, 480), 2)
    frame = np.full((region.height, region.width, 3), ground, np.uint8)
    columns = np.frombuffer(FONT.columns(words), np.uint8)
    ink = np.unpackbits(columns[np.newaxis], axis=0, bitorder="little") > 0
    left = (region.width // 2 - len(columns)) // 2
    at = frame[:, 2 * left : 2 * (left + len(columns))]
    at[np.repeat(np.repeat(ink, 2, 0), 2, 1)] = 255
    frame[:, 2 * left : 2 * (left + covered)] = 109
    return frame


@pytest.mark.parametrize("words", ["Game Paused", "Game paused"])
def test_the_words_are_seen_also_where_text_covers_a_part(words: str) -> None:
    assert shows_pause(picture(words), 2, FONT)
    assert shows_pause(picture(words, covered=18), 2, FONT)


@pytest.mark.parametrize("words", ["Game Menu", "Minecraft 26.3", "#### ## # #"])
def test_other_words_are_not(words: str) -> None:
    assert not shows_pause(picture(words), 2, FONT)


@pytest.mark.parametrize("ground", [0, 90, 255])
def test_a_ground_without_words_is_none(ground: int) -> None:
    assert not shows_pause(picture(" ", ground=ground), 2, FONT)
