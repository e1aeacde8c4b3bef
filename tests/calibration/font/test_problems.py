"""Why no font reads the screen, from frames painted for the test."""

from pathlib import Path

import numpy as np
import pytest

from calibration.font.problems import Candidate, fits_in_part, nothing_fits
from mc_nested.errors import FontError, UnreadableError
from mc_nested.live.devices import Frame
from sim.client.drawing.f3_layers import paint
from sim.client.game.f3_screen import F3Screen
from tests.sim.client.playing import FONT

MINE = Candidate(Path("mine.jar"), FONT)


def painted(scale: int) -> Frame:
    screen = F3Screen("1.16-1.19.2", scale, (8.5, 64.0, 3.5), 0.0, 65.0)
    return paint(np.full((800, 2600, 3), 120, np.uint8), screen, FONT)


def grey_with(share: float, shade: int) -> Frame:
    """A frame whose upper left, half as high and a third as wide, has that shade in a share of its pixels."""
    frame: Frame = np.full((200, 300, 3), 120, np.uint8)
    frame[:100, :100].reshape(-1, 3)[:] = 120
    frame[0, : round(share * 100 * 100)] = shade
    return frame


def test_a_unicode_font_is_named_whatever_is_seen() -> None:
    error = nothing_fits([painted(2)], [MINE], {"forceUnicodeFont": "true"})
    assert isinstance(error, FontError)
    assert "Force Unicode Font is on" in str(error)


@pytest.mark.parametrize("scale", [9, 10])
def test_a_gui_scale_that_is_too_large_is_named(scale: int) -> None:
    error = nothing_fits([grey_with(0, 0), painted(scale)], [MINE], {})
    assert isinstance(error, UnreadableError)
    assert f"the GUI scale is {scale}: choose 1 to 8 in" in str(error)


@pytest.mark.parametrize(("share", "shade"), [(0.0, 0), (0.002, 224), (0.005, 219), (0.005, 229)])
def test_without_enough_of_the_texts_colour_there_is_no_debug_screen(share: float, shade: int) -> None:
    error = nothing_fits([grey_with(share, shade)], [MINE], {})
    assert isinstance(error, UnreadableError)
    assert "no debug screen is to be seen" in str(error)
    assert "mine.jar" in str(error)


def test_a_pack_with_finer_letters_is_to_be_taken_off_and_not_to_be_named() -> None:
    assert "take off a pack with finer letters" in str(nothing_fits([grey_with(0.003, 224)], [MINE], {}))


@pytest.mark.parametrize("shade", [220, 224, 228])
def test_with_text_that_no_font_reads_the_font_is_the_wrong_one(shade: int) -> None:
    error = nothing_fits([grey_with(0.003, shade)], [MINE], {})
    assert isinstance(error, FontError)
    assert "fit none of these fonts: mine.jar" in str(error)
    assert "language" not in str(error)


@pytest.mark.parametrize(("language", "is_named"), [("en_us", False), ("EN_gb", False), ("de_de", True)])
def test_a_language_that_is_not_english_is_named(language: str, is_named: bool) -> None:
    error = nothing_fits([grey_with(0.003, 224)], [MINE], {"lang": language})
    assert (f"(it is {language})" in str(error)) is is_named


@pytest.mark.parametrize(("count", "end"), [(6, "5.jar"), (7, "5.jar and 1 more"), (9, "5.jar and 3 more")])
def test_six_fonts_are_named_and_the_rest_counted(count: int, end: str) -> None:
    candidates = [Candidate(Path(f"{number}.jar"), FONT) for number in range(count)]
    assert str(fits_in_part("no XYZ line", candidates)).endswith(end)
    assert str(fits_in_part("no XYZ line", candidates)).startswith("no XYZ line; ")
