"""The window's pixels as a GameScreen: scale, menus' texts, the line being typed, over a display of the test's own."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.game_screen import WORLDS_TITLE, WindowScreen
from mc_nested.live.vision.layout import VANILLA, Overlay
from scripts.benches.painted_screen import paint
from scripts.benches.reader import OneFrameDisplay
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.f3_screen import F3Screen
from tests.live.vision.menu_painter import GREY, MenuPainter

FONT = font_of(drawn_atlas())


def ground(width: int = 860, height: int = 480) -> Frame:
    return np.full((height, width, 3), 60, np.uint8)


def debug_screen(scale: int, frame: Frame) -> Frame:
    return paint(frame, F3Screen("1.16-1.19.2", scale, (8.5, 64.0, 3.5), 0.0, 65.0), FONT)


def painter(frame: Frame, scale: int) -> MenuPainter:
    return MenuPainter(frame, scale, FONT, np.random.default_rng(0))


def test_the_scale_is_measured_once_for_each_size_of_the_window() -> None:
    display = OneFrameDisplay(debug_screen(2, ground()))
    screen = WindowScreen(display, FONT)
    assert [screen.gui_scale(), screen.gui_scale(), display.whole_grabs] == [2, 2, 1]
    display.frame = debug_screen(3, ground(960, 720))
    assert [screen.gui_scale(), screen.gui_scale(), display.whole_grabs] == [3, 3, 2]


def test_the_gui_scale_is_kept_while_no_debug_screen_is_seen() -> None:
    display = OneFrameDisplay(debug_screen(2, ground()))
    screen = WindowScreen(display, FONT)
    screen.gui_scale()
    display.frame = ground(960, 720)
    assert screen.gui_scale() == 2


def test_a_given_overlay_sets_the_gui_scale_without_a_picture() -> None:
    display = OneFrameDisplay(ground())
    assert WindowScreen(display, FONT, Overlay(3, VANILLA, (224, 224, 224))).gui_scale() == 3
    assert display.whole_grabs == 0


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_the_gui_scale_is_found_on_the_list_of_worlds_before_any_debug_screen(scale: int) -> None:
    frame = ground()
    painter(frame, scale).text(WORLDS_TITLE, 50, 10)
    assert WindowScreen(OneFrameDisplay(frame), FONT).gui_scale() == scale


def test_an_unknown_gui_scale_counts_as_1() -> None:
    assert WindowScreen(OneFrameDisplay(ground()), FONT).gui_scale() == 1


@pytest.mark.parametrize("scale", [1, 2])
def test_a_white_text_is_found_by_its_middle_the_uppermost_first(scale: int) -> None:
    frame = ground()
    wide = len(FONT.columns("New World"))
    for top in (70, 30):
        painter(frame, scale).text("New World", 40, top)
    assert WindowScreen(OneFrameDisplay(frame), FONT).position_of("New World") == (
        int((40 + wide / 2) * scale),
        34 * scale,
    )


def test_position_of_ignores_a_longer_text_and_one_of_another_colour() -> None:
    frame = ground()
    painter(frame, 2).text("New World2", 40, 30)
    painter(frame, 2).text("New World", 40, 60, GREY)
    assert WindowScreen(OneFrameDisplay(frame), FONT).position_of("New World") is None


def test_the_chat_is_open_once_its_line_has_a_letter_and_its_text_is_compared_exactly() -> None:
    frame = ground()
    screen = WindowScreen(OneFrameDisplay(frame), FONT, Overlay(2, VANILLA, (224, 224, 224)))
    assert not screen.is_chat_open()
    assert screen.is_typed("")
    painter(frame, 2).text("/tp 1 2 3_", 4, 240 - 12, (224, 224, 224))
    assert screen.is_chat_open()
    assert screen.is_typed("/tp 1 2 3")
    assert not screen.is_typed("/tp 1 2")


def test_a_menus_texts_and_buttons_are_found_on_the_screen() -> None:
    frame = ground()
    middle = painter(frame, 2).button("Respawn", 115, 60, 200)
    menu = WindowScreen(OneFrameDisplay(frame), FONT).menu()
    assert menu.shows("Respawn")
    assert not menu.shows("Title Screen")
    found = menu.button("Respawn").middle
    assert found is not None
    assert max(abs(found[0] - middle[0]), abs(found[1] - middle[1])) <= 4


def test_read_position_gives_none_before_the_first_whole_reading() -> None:
    display = OneFrameDisplay(debug_screen(2, ground()))
    screen = WindowScreen(display, FONT)
    assert screen.read_position() is None, "it isn't known yet where the line stands"
    assert screen.read().xyz == (8.5, 64.0, 3.5)
