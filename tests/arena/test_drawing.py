"""The arena from above as text: which sign each cell gets.

The arena as a picture: where each cell lies, what tells its kind, and which way the agent looks.
"""

import dataclasses

import numpy as np
import pytest

from mc_nested.arena.drawing import (
    AGENT_ARROW,
    AGENT_BODY,
    BLOCKS,
    CELL_PX,
    DESIGN,
    GRID,
    GROUND,
    TO_BUILD,
    Picture,
    draw_objective,
    draw_picture,
    draw_text,
    kind_of,
)
from mc_nested.arena.scenario import Material, Scenario
from tests.arena.made_parts import STRIPES

PAIR = Scenario("pair", frozenset({(6, 14), (7, 14)}), (7, 12), 9, (Material("stone", 1.0, "stone"),))


def test_each_kind_of_cell_has_its_sign() -> None:
    placed = {(7, 14), (0, 3)}
    signs = {cell: kind_of(PAIR, (7, 13), placed, cell) for cell in [(7, 13), (7, 14), (0, 3), (6, 14), (9, 9)]}
    assert signs == {(7, 13): "^", (7, 14): "#", (0, 3): "x", (6, 14): "o", (9, 9): "."}


def test_a_cell_to_build_shows_the_number_of_its_part() -> None:
    assert draw_text(STRIPES, (1, 1), {(1, 3), (3, 2)}).splitlines() == [
        ". . . . .",
        ". # 1 . .",
        ". 2 2 # .",
        ". ^ . . .",
        ". . . . .",
    ]


def test_a_text_drawing_has_the_far_edge_on_top_and_no_agent_unless_given() -> None:
    lines = draw_text(PAIR, None, {(7, 14)}).splitlines()
    assert len(lines) == 15
    assert lines[0] == ". . . . . . o # . . . . . . ."
    assert not any("^" in line for line in lines)


@pytest.mark.parametrize("size", [8, 32])
def test_a_text_drawing_has_the_arenas_size(size: int) -> None:
    corner = dataclasses.replace(PAIR, design=frozenset({(size - 1, size - 1)}), start=(0, 0), size=size)
    lines = draw_text(corner, (0, 0), ()).splitlines()
    assert [len(line.split()) for line in lines] == [size] * size
    assert (lines[0].split()[-1], lines[-1].split()[0]) == ("o", "^")


BUILT, WRONG = (BLOCKS[kind][0] for kind in "#x")


def cell_of(picture: Picture, x: int, y: int, px: int = CELL_PX, size: int = 15) -> Picture:
    """Return the part of a picture that is one cell."""
    top, left = (size - 1 - y) * px, x * px
    return picture[top : top + px, left : left + px]


def middle(picture: Picture, x: int, y: int) -> list[int]:
    colour: list[int] = cell_of(picture, x, y)[CELL_PX // 2, CELL_PX // 2].tolist()
    return colour


def test_a_picture_colours_each_kind_of_cell_and_has_the_far_edge_on_top() -> None:
    picture = draw_picture(PAIR, None, {(7, 14), (0, 3)})
    assert picture.shape == (240, 240, 3)
    assert picture.dtype == np.uint8
    cells = [(7, 14), (6, 14), (0, 3), (9, 9)]
    assert [middle(picture, *cell) for cell in cells] == [list(each) for each in (BUILT, TO_BUILD[0], WRONG, GROUND)]


def test_only_the_designs_cells_are_outlined_whether_built_or_not() -> None:
    picture = draw_picture(PAIR, None, {(7, 14), (0, 3)})
    corner = [cell_of(picture, *cell)[1, 1].tolist() for cell in [(7, 14), (6, 14), (0, 3), (9, 9)]]
    assert [colour == list(DESIGN[0]) for colour in corner] == [True, True, False, False]


def test_a_grid_line_runs_before_every_row_and_column() -> None:
    picture = draw_picture(PAIR, (7, 12), {(7, 14)})
    assert (picture[::CELL_PX] == GRID).all()
    assert (picture[:, ::CELL_PX] == GRID).all()


def test_the_agents_arrow_points_up_and_leaves_its_cells_edge_visible() -> None:
    bare, shown = (cell_of(draw_picture(PAIR, agent, (), 32), 6, 14, 32) for agent in (None, (6, 14)))
    arrow = (shown == AGENT_ARROW).all(axis=2)
    wide = [int(np.ptp(np.flatnonzero(arrow[row]))) for row in (9, 14, 19)]
    assert (np.abs(shown[16, 7] - np.array(AGENT_BODY)) < 3).all()
    assert (shown[13, 16] == AGENT_ARROW).all()
    assert wide[0] < wide[1] < wide[2]
    assert (shown[:, :2] == bare[:, :2]).all()
    np.testing.assert_array_equal(arrow[:, 1:], arrow[:, :0:-1])


def test_the_agent_changes_no_other_cell() -> None:
    with_agent, without = (draw_picture(PAIR, agent, {(7, 14)}) for agent in ((7, 13), None))
    changed = np.argwhere((with_agent != without).any(axis=2)) // CELL_PX
    assert {(int(row), int(column)) for row, column in changed} == {(1, 7)}


@pytest.mark.parametrize(("size", "px"), [(8, 16), (32, 15), (5, 96)])
def test_a_picture_has_cells_of_the_requested_size(size: int, px: int) -> None:
    corner = dataclasses.replace(PAIR, design=frozenset({(size - 1, size - 1)}), start=(0, 0), size=size)
    picture = draw_picture(corner, (0, 0), (), px)
    assert picture.shape == (size * px, size * px, 3)
    at = px // 2
    assert cell_of(picture, size - 1, size - 1, px, size)[at, at].tolist() == list(TO_BUILD[0])
    reds = (picture[..., 0] > 190) & (picture[..., 1] < 80)
    assert reds[-px:, :px].any()
    assert not reds[:-px].any()


def test_changing_a_picture_does_not_change_the_next_one() -> None:
    first = draw_picture(PAIR, None, ())
    first[:] = 0
    assert draw_picture(PAIR, None, ()).any()


def test_each_part_of_a_design_has_its_own_colour_whether_built_or_not() -> None:
    picture = draw_picture(STRIPES, None, {(1, 3), (3, 2)}, 20)
    far, near = (cell_of(picture, *cell, 20, 5) for cell in ((2, 3), (1, 2)))
    assert [cell[10, 10].tolist() for cell in (far, near)] == [list(colour) for colour in TO_BUILD[:2]]
    built = [cell_of(picture, *cell, 20, 5)[1, 1].tolist() for cell in ((1, 3), (3, 2))]
    assert built == [list(colour) for colour in DESIGN[:2]]


def test_an_objective_is_framed_in_its_cell_alone() -> None:
    picture, without = draw_picture(PAIR, None, {(7, 14)}, 32), draw_picture(PAIR, None, {(7, 14)}, 32)
    draw_objective(picture, PAIR.size, (6, 14), 32)
    cell = cell_of(picture, 6, 14, 32)
    assert [cell[at].tolist() for at in ((2, 2), (30, 16))] == [list(AGENT_BODY)] * 2
    assert cell[16, 16].tolist() == list(TO_BUILD[0])
    changed = np.argwhere((picture != without).any(axis=2)) // 32
    assert {(int(row), int(column)) for row, column in changed} == {(0, 6)}
