"""One line read on pictures painted for the test: in the box, out of it, aligned, covered."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.layout import STANDIN, VANILLA, Overlay
from mc_nested.live.vision.text_lines import (
    UNKNOWN,
    Line,
    columns_of,
    decode,
    ink_of,
    is_text,
    line_from,
    line_up_to,
    positions_of,
)
from sim.client.drawing.letters import drawn_atlas

FONT = font_of(drawn_atlas())
DRAWN = Overlay(1, VANILLA, (224, 224, 224))
STANDIN_DRAWN = Overlay(1, STANDIN, (255, 255, 255))
BOXES = {VANILLA: 80, STANDIN: 110}
ROW, START = 4, 20


def wide(text: str) -> int:
    """Return the columns from the first ink to the last."""
    return len(FONT.columns(text)) - 1


def ink(frame: Frame, text: str, start: int, colour: tuple[int, int, int]) -> None:
    columns = np.frombuffer(FONT.columns(text), np.uint8)
    bits = np.unpackbits(columns[np.newaxis], axis=0, bitorder="little").astype(bool)
    frame[ROW : ROW + 8, start : start + len(columns)][bits] = colour[::-1]


def painted(text: str, overlay: Overlay = DRAWN, start: int = START, ground: int = 200, size: int = 600) -> Frame:
    """Return a line in its box over a flat world, 200 or what else is given."""
    frame: Frame = np.full((20, size, 3), ground, np.uint8)
    behind = overlay.layout.box.behind
    frame[ROW - 1 : ROW + 8, start - 1 : start + wide(text) + behind] = (ground + overlay.layout.box.grey) // 2
    ink(frame, text, start, overlay.colour)
    return frame


def grid(frame: Frame) -> GlyphGrid:
    return GlyphGrid(frame, 1, 220)


def read(frame: Frame, overlay: Overlay = DRAWN, edge: int | None = None) -> Line:
    return line_from(grid(frame), FONT, overlay, (ROW, START), edge)


@pytest.mark.parametrize("overlay", [DRAWN, STANDIN_DRAWN])
@pytest.mark.parametrize("text", ["XYZ: -8.500 / 64.00000 / 1.2", "#c:villager_job", "a  b   c"])
def test_a_line_is_read_from_its_start_and_from_its_end(text: str, overlay: Overlay) -> None:
    frame = painted(text, overlay)
    line = Line(text, ROW, START, START + wide(text) - 1, whole=True, is_left=True)
    assert read(frame, overlay) == line
    assert line_up_to(grid(frame), FONT, overlay, (ROW, line.end)) == line


def test_positions_of_finds_a_text_within_a_line() -> None:
    found = positions_of(grid(painted("Targeted Block")), FONT, "Block")
    assert found == [(ROW, START + len(FONT.columns("Targeted ")))]


@pytest.mark.parametrize(("start", "is_left"), [(149, True), (150, False)])
def test_a_line_that_begins_in_the_windows_first_quarter_is_in_the_left_column(start: int, is_left: bool) -> None:
    frame = painted("abc", start=start)
    assert line_from(grid(frame), FONT, DRAWN, (ROW, start)).is_left is is_left
    line = line_up_to(grid(frame), FONT, DRAWN, (ROW, start + wide("abc") - 1))
    assert line is not None
    assert line.is_left is is_left


def test_a_line_longer_than_most_is_read_to_its_end() -> None:
    text = "m" * 60
    assert wide(text) > 288
    assert read(painted(text)).text == text


def test_three_spaces_are_read_and_four_end_the_line() -> None:
    assert read(painted("a   b")).text == "a   b"
    assert read(painted("a    b")).text == "a"


def test_text_behind_the_box_is_not_read() -> None:
    frame = painted("abc")
    ink(frame, "d", START + len(FONT.columns("abc")) + 8, DRAWN.colour)
    assert read(frame).text == "abc"


def test_a_line_is_read_only_up_to_the_edge_that_it_is_aligned_at() -> None:
    frame = painted("abc d")
    end = START + wide("abc") - 1
    assert read(frame, edge=end).text == "abc"
    assert read(frame, edge=end).end == end
    assert read(frame, edge=end + 1).text == "abc d", "the line isn't seen to end there"
    assert read(frame, edge=START + wide("abc d") - 1).text == "abc d"


def test_an_edge_in_the_middle_of_a_glyph_is_ignored() -> None:
    assert read(painted("abc"), edge=START + wide("ab") + 2).text == "abc"


def test_a_line_that_goes_on_behind_the_edge_is_not_whole_up_to_it() -> None:
    line = read(painted("abcd"), edge=START + wide("abc") - 1)
    assert (line.text, line.whole) == ("abc", False)


def test_ink_that_matches_no_glyph_is_unknown() -> None:
    frame = painted("abc")
    middle = START + len(FONT.columns("a"))
    frame[ROW : ROW + 8, middle : middle + 3] = 224
    assert UNKNOWN in read(frame).text


def test_a_glyph_off_its_position_is_unknown() -> None:
    frame = painted("ab  ")
    ink(frame, "c", START + len(FONT.columns("ab")) + 2, DRAWN.colour)
    assert read(frame).text == f"ab{UNKNOWN}c"


@pytest.mark.parametrize("colour", [(85, 255, 85), (255, 85, 85)])
def test_a_value_in_its_own_colour_is_read_from_its_end(colour: tuple[int, int, int]) -> None:
    frame = painted("axis: true")
    ink(frame, "true", START + len(FONT.columns("axis: ")), colour)
    line = line_up_to(grid(frame), FONT, DRAWN, (ROW, START + wide("axis: true") - 1))
    assert line is not None
    assert (line.text, line.has_value) == ("axis: true", True)


@pytest.mark.parametrize("off", [-3, -1, 1])
def test_line_up_to_gives_none_unless_the_last_ink_is_in_the_given_column(off: int) -> None:
    end = START + wide("abi") - 1  # an i is one column wide
    assert line_up_to(grid(painted("abi")), FONT, DRAWN, (ROW, end + off)) is None


@pytest.mark.parametrize("row", [-1, 13, 20])
def test_no_line_is_found_in_rows_outside_the_frame(row: int) -> None:
    frame = painted("abc")
    assert line_up_to(grid(frame), FONT, DRAWN, (row, START + wide("abc") - 1)) is None
    assert not is_text(grid(frame), FONT, DRAWN, (row, START))


def test_line_up_to_begins_behind_a_wide_gap() -> None:
    frame = painted("far      near")
    line = line_up_to(grid(frame), FONT, DRAWN, (ROW, START + wide("far      near") - 1))
    assert line is not None
    assert line.text == "near"
    assert line.start == START + len(FONT.columns("far      "))


@pytest.mark.parametrize(("text", "is_one"), [("abc", True), ("abcdefghij", True), ("ab", False), ("", False)])
def test_three_letters_or_more_count_as_text(text: str, is_one: bool) -> None:
    assert is_text(grid(painted(text)), FONT, DRAWN, (ROW, START)) is is_one


def test_three_letters_with_an_unknown_one_do_not_count_as_text() -> None:
    frame = painted("abc")
    frame[ROW : ROW + 8, START + 1] = 224
    assert not is_text(grid(frame), FONT, DRAWN, (ROW, START))


@pytest.mark.parametrize("overlay", [DRAWN, STANDIN_DRAWN])
@pytest.mark.parametrize("shade", [0, 30, 100, 240])
def test_a_line_with_something_over_its_last_columns_is_not_whole(overlay: Overlay, shade: int) -> None:
    frame = painted("abcdef", overlay)
    assert read(frame, overlay).whole
    end = START + len(FONT.columns("abcd"))
    frame[:, end - 1 : end + 30] = shade
    line = read(frame, overlay)
    assert (line.text, line.whole) == ("abcd", False)


def test_a_line_over_a_world_as_grey_as_its_box_is_whole() -> None:
    for overlay in (DRAWN, STANDIN_DRAWN):
        grey = overlay.layout.box.grey
        assert read(painted("abc", overlay, ground=grey), overlay).whole
        assert read(painted("abc", overlay, ground=grey + 5), overlay).whole
    frame = painted("abc", ground=100)
    frame[ROW - 1 : ROW + 8, START - 1 : START + 60][frame[ROW - 1 : ROW + 8, START - 1 : START + 60] == 90] = 100
    assert not read(frame).whole, "flat, and not the box's grey"


@pytest.mark.parametrize(
    ("ground", "box", "is_whole"),
    [(102, 100, False), (103, 100, True), (98, 100, False), (85, 85, True), (86, 86, False)],
)
def test_a_line_is_whole_if_its_box_ends_in_a_step_of_3_greys_or_in_its_own_grey(
    ground: int, box: int, is_whole: bool
) -> None:
    frame = painted("abc", ground=ground)
    frame[frame == (ground + 80) // 2] = box
    assert read(frame).whole is is_whole


def test_ink_is_within_4_of_its_colour_in_every_channel() -> None:
    row = np.array([[(224, 224, 224), (220, 228, 224), (219, 224, 224), (224, 229, 224), (224, 224, 230)]], np.uint8)
    assert ink_of(row, (224, 224, 224)).tolist() == [[255, 255, 0, 0, 0]]
    assert ink_of(np.array([[(10, 20, 30), (30, 20, 10)]], np.uint8), (30, 20, 10)).tolist() == [[255, 0]]
    assert ink_of(row, (224, 224, 224), (219, 224, 230)).tolist() == [[255, 255, 0, 0, 0]]


def test_the_lowest_bit_of_a_column_is_its_uppermost_dot() -> None:
    mask = np.zeros((8, 3), np.uint8)
    mask[0, 0] = mask[7, 1] = mask[1, 1] = 255
    assert columns_of(mask) == bytes((1, 130, 0))


def test_decode_returns_the_text_and_the_column_of_its_last_ink() -> None:
    assert decode(FONT.columns("ab c"), FONT) == ("ab c", wide("ab c") - 1)
    assert decode(b"\0\0\0", FONT) == ("", -1)
    assert decode(b"", FONT) == ("", -1)
