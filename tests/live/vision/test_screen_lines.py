"""The lines of painted screens: found once, kept for reading them again, and cut where the world begins."""

import re

import numpy as np
import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.overlay import FoundScreen, find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines, Unreadable, check_whole, matched, only_line, shown
from mc_nested.live.vision.text_lines import UNKNOWN, positions_of
from scripts.benches.painted_screen import paint
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


def test_starting_reads_the_line_from_the_label_on() -> None:
    lines = lines_of()
    assert [line.text for line in lines.starting("XYZ:")] == ["XYZ: 8.500 / 64.00000 / 3.500"]
    assert [line.text for line in lines.starting("64.0")] == ["64.00000 / 3.500"]
    assert lines.holds("ted Block")
    assert not lines.holds("Looking at")


def test_the_right_column_is_read_from_the_top_even_if_the_last_dot_is_cut() -> None:
    texts = [line.text for line in lines_of(size=(480, 861)).right_column()]
    assert texts[0] == "Java: 21.0.3 64bit"
    assert texts[-3:] == ["Targeted Block: 8, 63, 4", "minecraft:oak_log", "axis: y"]


def test_the_stand_ins_right_column_gives_no_lines() -> None:
    assert lines_of("standin").right_column() == []


def test_screen_lines_keep_where_the_requested_lines_stood() -> None:
    lines = lines_of()
    label = only_line(lines, "Targeted Block")
    assert label is not None
    assert lines.ending(label.row + 9, label.end)
    assert lines.positions_seen == {"Targeted Block": [(label.row, label.start)]}
    assert lines.rows_read == {label.row, label.row + 9}


def test_remembered_lines_are_read_without_a_search() -> None:
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


def test_a_left_line_can_be_cut_to_its_beginning_and_is_then_not_whole() -> None:
    lines = lines_of()
    (line,) = lines.starting("XYZ:")
    cut = lines.cut(line, "XYZ: 8.500")
    assert cut is not None
    assert (cut.text, cut.row, cut.start, cut.whole) == ("XYZ: 8.500", line.row, line.start, False)
    assert cut.end == line.start + len(FONT.columns("XYZ: 8.500")) - 2
    assert lines.cut(line, line.text) is line


def test_a_line_can_not_be_cut_to_another_or_an_unknown_text() -> None:
    lines = lines_of()
    (line,) = lines.starting("XYZ:")
    assert lines.cut(line, "XYZ: 9.500") is None
    assert lines.cut(line, f"XYZ: {UNKNOWN}.500") is None


def test_a_right_line_can_not_be_cut() -> None:
    lines = lines_of()
    (line,) = lines.starting("Targeted Block")
    assert lines.cut(line, "Targeted Block") is None


def test_only_line_raises_for_two_lines_and_gives_none_for_no_line() -> None:
    lines = WrittenLines(written("Facing: north", 1), written("Facing: south", 2), written("XYZ: 1", 3))
    with pytest.raises(Unreadable, match="2 lines begin with 'Facing:'"):
        only_line(lines, "Facing: ")
    assert only_line(lines, "XYZ:") == written("XYZ: 1", 3)
    assert only_line(lines, "Block:") is None


def test_messages_show_unknown_glyphs_as_question_marks() -> None:
    assert shown(f"XYZ: {UNKNOWN}.5") == "'XYZ: ?.5'"
    with pytest.raises(Unreadable, match=r"the end of 'XYZ: [?][.]5' may be covered"):
        check_whole(written(f"XYZ: {UNKNOWN}.5", 0, whole=False))
    check_whole(written("XYZ: 1.5", 0))


def test_matching_a_missing_line_is_unreadable() -> None:
    with pytest.raises(Unreadable, match="a line reads ''"):
        matched(re.compile(".*"), None)
    assert matched(re.compile("(X).*(Z)"), written("XYZ", 0)) == ("X", "Z")
