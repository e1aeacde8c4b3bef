"""A picture of a film: the arena with its words, and the window beside it."""

import dataclasses

import numpy as np
import pytest

from mc_nested.arena.drawing import Picture, draw_picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.report.arena_picture import (
    ARENA_PX,
    CAPTION,
    LINES,
    MARGIN,
    PAPER,
    SMALL_ARENA_PX,
    STEP_PX,
    Moment,
    beside,
    box_for,
    draw_moment,
)
from tests.report.films import flat

LINE = load_scenario("line")
STONE = LINE.best_material
START = Moment(LINE.start, (), 0, STONE, 10.0)


def words_of(picture: Picture) -> Picture:
    return picture[:CAPTION]


@pytest.mark.parametrize(
    ("arena_px", "size", "px"), [(390, 15, 26), (390, 32, 12), (390, 5, 78), (210, 15, 14), (210, 32, 6)]
)
def test_every_arena_fills_the_same_square(arena_px: int, size: int, px: int) -> None:
    scenario = dataclasses.replace(LINE, design=frozenset({(2, 2)}), start=(1, 1), size=size)
    picture = draw_moment(scenario, Moment((1, 1), {(2, 2), (3, 3)}, 4, STONE, 12.0), arena_px)
    assert picture.shape == (arena_px + CAPTION + MARGIN, arena_px + 2 * MARGIN, 3)
    side = size * px
    top, left = CAPTION + (arena_px - side) // 2, (picture.shape[1] - side) // 2
    expected = draw_picture(scenario, (1, 1), {(2, 2), (3, 3)}, px)
    np.testing.assert_array_equal(picture[top : top + side, left : left + side], expected)


@pytest.mark.parametrize(
    "changed",
    [
        Moment(LINE.start, (), 1, STONE, 10.0),
        Moment(LINE.start, {(7, 5)}, 0, STONE, 11.0),
        Moment(LINE.start, (), 0, 1 - STONE, -5.0),
    ],
    ids=["another step", "a block", "another material"],
)
def test_the_caption_changes_with_the_step_the_blocks_and_the_material(changed: Moment) -> None:
    assert (words_of(draw_moment(LINE, changed)) != words_of(draw_moment(LINE, START))).any()


def test_the_caption_does_not_depend_on_the_agents_cell() -> None:
    elsewhere = draw_moment(LINE, Moment((3, 3), (), 0, STONE, 10.0))
    np.testing.assert_array_equal(words_of(elsewhere), words_of(draw_moment(LINE, START)))


def test_a_long_name_ends_before_the_edge() -> None:
    named = dataclasses.replace(LINE, name="W" * 60)
    words = words_of(draw_moment(named, START, SMALL_ARENA_PX))[: LINES[1]]
    plain = words_of(draw_moment(LINE, START, SMALL_ARENA_PX))[: LINES[1]]
    assert (words[:, :MARGIN] == PAPER).all()
    assert (words[:, SMALL_ARENA_PX // 2 : -MARGIN - STEP_PX] != PAPER).any()
    np.testing.assert_array_equal(words[:, -MARGIN - STEP_PX :], plain[:, -MARGIN - STEP_PX :])


def test_a_window_is_drawn_beside_the_arena_at_the_arenas_height() -> None:
    picture, window = draw_moment(LINE, START), flat((9, 99, 199), 1280, 720)
    box = box_for(window)
    assert box == (round(ARENA_PX * 16 / 9), ARENA_PX)
    both = beside(picture, window, box)
    assert both.shape == (picture.shape[0], picture.shape[1] + box[0] + MARGIN, 3)
    np.testing.assert_array_equal(both[:, : picture.shape[1]], picture)
    assert (both[CAPTION : CAPTION + ARENA_PX, picture.shape[1] : -MARGIN] == (9, 99, 199)).all()
    assert (both[: LINES[1], picture.shape[1] :] == PAPER).all()
    assert (both[LINES[1] : CAPTION, picture.shape[1] :] != PAPER).any()


def test_a_window_of_another_size_is_fitted_into_the_same_box() -> None:
    picture, box = draw_moment(LINE, START), (600, ARENA_PX)
    shapes = {beside(picture, flat((0, 0, 0), width, height), box).shape for width, height in [(900, 576), (100, 576)]}
    assert len(shapes) == 1
    narrow = beside(picture, flat((0, 0, 0), 100, 576), box)[CAPTION : CAPTION + ARENA_PX, picture.shape[1] : -MARGIN]
    dark = (narrow == 0).all(axis=(0, 2))
    assert dark.sum() == round(100 * ARENA_PX / 576)
    assert (narrow[:, ~dark] == PAPER).all()
