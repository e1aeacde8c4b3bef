"""The stand-in's lines of the block looked at, written down."""

import dataclasses

import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.layout import STANDIN
from mc_nested.live.vision.screen_lines import Unreadable
from mc_nested.live.vision.target_block import target_block
from mc_nested.live.vision.text_lines import UNKNOWN, Line
from tests.live.vision.written_lines import WrittenLines
from tests.live.vision.written_lines import written as written_9

FIRST = written_9("Renderer: three.js", 0, right=True)


def written(text: str, number: int, *, whole: bool = True) -> Line:
    return written_9(text, number, right=True, whole=whole, pitch=10)


def of(*lines: Line) -> Target | None:
    return target_block(WrittenLines(*lines, layout=STANDIN))


def why_not(*lines: Line) -> str:
    with pytest.raises(Unreadable) as raised:
        of(*lines)
    return str(raised.value)


LOOKING = written("Looking at: 1 2 3", 6)


def test_the_stand_ins_lines_are_10_apart_white_and_in_no_grid() -> None:
    assert (STANDIN.name, STANDIN.pitch, STANDIN.text_colour, STANDIN.has_one_grid) == (
        "stand-in",
        10,
        (255, 255, 255),
        False,
    )


def test_the_blocks_name_is_read_above_its_position() -> None:
    assert of(FIRST, written("oak_log", 5), LOOKING) == Target((1, 2, 3), "oak_log")


def test_the_blocks_name_is_found_above_its_properties() -> None:
    value = dataclasses.replace(written("snowy: true", 4), has_value=True)
    lines = (written("oak_log", 3), value, written("axis: y", 5))
    assert of(FIRST, *lines, LOOKING) == Target((1, 2, 3), "oak_log")


def test_a_value_whose_property_is_covered_is_not_taken_for_the_name() -> None:
    value = dataclasses.replace(written("true", 5), has_value=True)
    assert "the block's name reads 'true'" in why_not(FIRST, written("oak_log", 4), value, LOOKING)


def test_a_partly_covered_property_is_skipped() -> None:
    assert of(FIRST, written("oak_log", 4), written(f"a{UNKNOWN}s: y", 5), LOOKING) == Target((1, 2, 3), "oak_log")


@pytest.mark.parametrize(("number", "is_read"), [(8, True), (7, False)])
def test_a_name_is_looked_for_up_to_12_lines_above(number: int, is_read: bool) -> None:
    lines = (FIRST, written("oak_log", number), written("Looking at: 1 2 3", 20))
    if is_read:
        assert of(*lines) == Target((1, 2, 3), "oak_log")
    else:
        assert "the name of the block looked at can't be seen" in why_not(*lines)


def test_a_text_that_is_not_a_block_name_is_reported() -> None:
    assert "the block's name reads 'oak log'" in why_not(FIRST, written("oak log", 5), LOOKING)


def test_a_name_whose_end_may_be_covered_is_not_read() -> None:
    assert "the end of 'oak_log' may be covered" in why_not(FIRST, written("oak_log", 5, whole=False), LOOKING)


def test_a_position_that_ends_before_the_columns_end_may_be_covered() -> None:
    short = dataclasses.replace(LOOKING, end=LOOKING.end - 6)
    assert "the end of 'Looking at: 1 2 3' may be covered" in why_not(FIRST, written("oak_log", 5), short)


def test_the_target_is_unknown_without_the_columns_first_line() -> None:
    assert "the upper right of the debug screen can't be seen" in why_not(written("oak_log", 5), LOOKING)
    assert "the upper right of the debug screen can't be seen" in why_not()


def test_an_empty_column_means_no_target() -> None:
    assert of(FIRST) is None


@pytest.mark.parametrize(("below", "is_seen"), [(19, True), (9, False), (20, False), (159, True), (169, False)])
def test_an_unexplained_text_where_a_block_may_stand_is_unreadable(below: int, is_seen: bool) -> None:
    # An empty line is 9 high: the block's lines begin 19 below the first line, and up to 15 of them are looked through.
    line = dataclasses.replace(written("oak_log", 0), row=FIRST.row + below)
    if is_seen:
        assert "what 'oak_log' in the right column belongs to can't be seen" in why_not(FIRST, line)
    else:
        assert of(FIRST, line) is None


def test_a_speck_in_the_column_is_ignored() -> None:
    speck = dataclasses.replace(written(f"i{UNKNOWN}", 0), row=FIRST.row + 19)
    assert of(FIRST, speck) is None
