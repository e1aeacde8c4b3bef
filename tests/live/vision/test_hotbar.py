"""The hotbar's look, on dots drawn by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame
from mc_nested.live.vision.hotbar import HotbarLook, bottom_dots, bottom_region, hotbar_look, typed_dots

SIZE, GUI_HEIGHT = (854, 480), 240


def dots(black: float = 0, light: float = 0x93, grey: float = 0x7E) -> Frame:
    """The bottom of a window at GUI scale 2, noise with a hotbar whose rows have these greys."""
    region = bottom_region(SIZE, 2)
    noise = np.random.default_rng(0).integers(0, 256, (21, region.width // 2, 3)).astype(np.uint8)
    for row, shade in ((0, black), (1, light), (19, grey)):
        noise[row, -182:] = round(shade)
    return noise


def test_the_region_begins_at_the_first_letter_and_ends_with_the_hotbar() -> None:
    region = bottom_region(SIZE, 2)
    assert (region.left, region.left + region.width) == (8, (427 // 2 + 1 + 90) * 2)
    assert (region.top, region.height) == ((240 - 22) * 2, 21 * 2)


def test_a_window_that_cuts_its_last_dot_has_the_same_rows() -> None:
    region = bottom_region((1920, 1057), 4)
    frame = np.zeros((region.height, region.width, 3), np.uint8)
    assert region.top + region.height <= 1057
    assert bottom_dots(frame, 4).shape[0] == 21


@pytest.mark.parametrize(
    ("drawn", "look"),
    [
        (dots(), "clear"),
        (dots(grey=0x7E / 2), "behind the chat"),
        (dots(light=0x93 * 0.95), None),
        (dots(black=10), None),
        (np.zeros((21, 300, 3), np.uint8), None),
        (np.full((21, 300, 3), 0x93, np.uint8), None),
        (dots()[:10], None),
        (dots()[:, :100], None),
    ],
)
def test_only_its_own_greys_are_clear(drawn: Frame, look: HotbarLook | None) -> None:
    assert hotbar_look(drawn, GUI_HEIGHT) == look


@pytest.mark.parametrize(("covered", "look"), [(120, "clear"), (130, None)])
def test_text_may_cover_its_left_part(covered: int, look: HotbarLook | None) -> None:
    drawn = dots()
    drawn[:, -182 : -182 + covered] = 109
    assert hotbar_look(drawn, GUI_HEIGHT) == look


def test_behind_the_death_screen_it_is_red_by_the_height() -> None:
    drawn = dots()
    for row, grey in ((0, 0), (1, 0x93)):
        down = (GUI_HEIGHT - 22 + row + 0.5) / GUI_HEIGHT
        alpha = (0x60 + (0xA0 - 0x60) * down) / 255
        red, other = 0x50 + (0x80 - 0x50) * down, 0x30 * down
        shades = [grey * (1 - alpha) + part * alpha for part in (other, other, red)]
        drawn[row, -182:] = np.rint(shades)
    assert hotbar_look(drawn, GUI_HEIGHT) == "death"


@given(st.floats(0.0, 0.96), st.integers(0, 40))
def test_whatever_darkens_it_it_is_not_clear(share: float, over: int) -> None:
    drawn = dots()
    drawn[:, -182:] = np.rint(drawn[:, -182:] * share + over * (1 - share))
    assert hotbar_look(drawn, GUI_HEIGHT) != "clear"


def test_the_first_letters_dots_are_those_of_the_line_being_typed() -> None:
    drawn = np.zeros((21, 300, 3), np.uint8)
    drawn[10, 0] = 224
    assert typed_dots(drawn).shape == (9, 8, 3)
    assert typed_dots(drawn)[0, 0, 0] == 224
