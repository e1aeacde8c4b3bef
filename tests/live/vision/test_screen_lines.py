"""The lines of painted screens: found once, kept for reading them again, and cut where the world begins."""

import re

import numpy as np
import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.overlay import FoundScreen, find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines, Unreadable, check_whole, matched, only_line, shown
from mc_nested.live.vision.text_lines import UNKNOWN, positions_of
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from tests.live.vision.written_lines import WrittenLines, written

FONT = font_of(drawn_atlas())


def found_in(layout: Layout = "1.16-1.19.2", size: tuple[int, int] = (480, 861)) -> FoundScreen:
    name = "oak_log" if layout == "standin" else "minecraft:oak_log"
    screen = F3Screen(layout, 2, (8.5, 64.0, 3.5), 0.0, 65.0, Target((8, 63, 4), name), (("axis", "y"),))
    found = find_debug_screen(paint(np.full((*size, 3), 120, np.uint8), screen, FONT), FONT)
    assert found is not None
    return found


def lines_of(layout: Layout = "1.16-1.19.2", size: tuple[int, int] = (480, 861)) -> ScreenLines:
    found = found_in(layout, size)
    return ScreenLines(found.dots, FONT, found.overlay)


def test_a_label_gives_the_line_from_there_on() -> None:
    lines = lines_of()
    assert [line.text for line in lines.starting("XYZ:")] == ["XYZ: 8.500 / 64.00000 / 3.500"]
    assert [line.text for line in lines.starting("64.0")] == ["64.00000 / 3.500"]
    assert lines.holds("ted Block")
    assert not lines.holds("Looking at")


def test_the_right_column_is_read_from_above_even_where_the_last_dot_is_cut() -> None:
    texts = [line.text for line in lines_of(size=(480, 861)).right_column()]
    assert texts[0] == "Java: 21.0.3 64bit"
    assert texts[-3:] == ["Targeted Block: 8, 63, 4", "minecraft:oak_log", "axis: y"]


def test_where_the_layout_does_not_say_where_the_right_column_ends_it_has_no_lines() -> None:
    assert lines_of("standin").right_column() == []


def test_screen_lines_keep_where_the_requested_lines_stood() -> None:
    lines = lines_of()
    label = only_line(lines, "Targeted Block")
    assert label is not None
    assert lines.ending(label.row + 9, label.end)
    assert lines.positions_seen == {"Targeted Block": [(label.row, label.start)]}
    assert lines.rows_read == {label.row, label.row + 9}


def test_remembered_lines_are_not_looked_for() -> None:
    found = found_in()
    (position,) = positions_of(found.dots, FONT, "XYZ:")
    lines = ScreenLines(found.dots, FONT, found.overlay, {"XYZ:": [position]})
    assert [line.text for line in lines.starting("XYZ:")] == ["XYZ: 8.500 / 64.00000 / 3.500"]
    assert lines.starting("Facing: ") == []


def test_a_remembered_line_that_stands_elsewhere_is_unreadable() -> None:
    found = found_in()
    lines = ScreenLines(found.dots, FONT, found.overlay, {"Facing: ": positions_of(found.dots, FONT, "XYZ:")})
    with pytest.raises(Unreadable, match="the line that began with 'Facing:' is not where it was"):
        lines.starting("Facing: ")


def test_a_line_on_the_left_is_cut_where_a_text_ends_and_seen_whole_only_at_its_boxs_end() -> None:
    lines = lines_of()
    (line,) = lines.starting("XYZ:")
    cut = lines.cut(line, "XYZ: 8.500")
    assert cut is not None
    assert (cut.text, cut.row, cut.start, cut.whole) == ("XYZ: 8.500", line.row, line.start, False)
    assert cut.end == line.start + len(FONT.columns("XYZ: 8.500")) - 2
    assert lines.cut(line, line.text) is line


def test_a_line_is_not_cut_to_a_text_that_it_does_not_begin_with_or_that_is_not_known() -> None:
    lines = lines_of()
    (line,) = lines.starting("XYZ:")
    assert lines.cut(line, "XYZ: 9.500") is None
    assert lines.cut(line, f"XYZ: {UNKNOWN}.500") is None


def test_a_line_on_the_right_is_not_cut() -> None:
    lines = lines_of()
    (line,) = lines.starting("Targeted Block")
    assert lines.cut(line, "Targeted Block") is None


def test_two_lines_with_one_label_are_unreadable_and_no_line_gives_none() -> None:
    lines = WrittenLines(written("Facing: north", 1), written("Facing: south", 2), written("XYZ: 1", 3))
    with pytest.raises(Unreadable, match="2 lines begin with 'Facing:'"):
        only_line(lines, "Facing: ")
    assert only_line(lines, "XYZ:") == written("XYZ: 1", 3)
    assert only_line(lines, "Block:") is None


def test_a_message_shows_what_is_unknown_as_a_question_mark() -> None:
    assert shown(f"XYZ: {UNKNOWN}.5") == "'XYZ: ?.5'"
    with pytest.raises(Unreadable, match=r"the end of 'XYZ: [?][.]5' may be covered"):
        check_whole(written(f"XYZ: {UNKNOWN}.5", 0, whole=False))
    check_whole(written("XYZ: 1.5", 0))


def test_a_line_that_is_not_there_has_no_form() -> None:
    with pytest.raises(Unreadable, match="a line reads ''"):
        matched(re.compile(".*"), None)
    assert matched(re.compile("(X).*(Z)"), written("XYZ", 0)) == ("X", "Z")
