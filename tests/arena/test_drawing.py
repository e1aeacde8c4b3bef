"""The arena from above: which sign and which colour each cell gets."""

import dataclasses

import pytest

from mc_nested.arena.drawing import CELL_PX, COLOURS, draw_picture, draw_text, kind_of
from mc_nested.arena.scenario import Material, Scenario

PAIR = Scenario("pair", frozenset({(6, 14), (7, 14)}), (7, 12), 9, (Material("stone", 1.0, "stone"),))


def test_each_kind_of_cell_has_its_sign() -> None:
    placed = {(7, 14), (0, 3)}
    signs = {cell: kind_of(PAIR, (7, 13), placed, cell) for cell in [(7, 13), (7, 14), (0, 3), (6, 14), (9, 9)]}
    assert signs == {(7, 13): "^", (7, 14): "#", (0, 3): "x", (6, 14): "o", (9, 9): "."}


def test_without_an_agent_none_is_drawn_and_the_far_edge_is_on_top() -> None:
    lines = draw_text(PAIR, None, {(7, 14)}).splitlines()
    assert len(lines) == 15
    assert lines[0] == ". . . . . . o # . . . . . . ."
    assert not any("^" in line for line in lines)


def test_a_cell_of_the_picture_has_its_colour_and_a_line_before_it() -> None:
    picture = draw_picture(PAIR, (7, 12), ())
    top, left = 2 * CELL_PX, 7 * CELL_PX
    assert picture[top, left].tolist() == [200, 200, 200]
    assert picture[top + 1, left + 1].tolist() == list(COLOURS["^"])
    assert picture[top + CELL_PX - 1, left + CELL_PX - 1].tolist() == list(COLOURS["^"])
    assert picture[top + CELL_PX, left + 1].tolist() == [200, 200, 200]


@pytest.mark.parametrize("size", [8, 32])
def test_an_arena_is_drawn_as_large_as_it_is(size: int) -> None:
    corner = dataclasses.replace(PAIR, design=frozenset({(size - 1, size - 1)}), start=(0, 0), size=size)
    lines = draw_text(corner, (0, 0), ()).splitlines()
    assert [len(line.split()) for line in lines] == [size] * size
    assert (lines[0].split()[-1], lines[-1].split()[0]) == ("o", "^")
    picture = draw_picture(corner, (0, 0), ())
    assert picture.shape == (size * CELL_PX, size * CELL_PX, 3)
    assert picture[1, -1].tolist() == list(COLOURS["o"])
    assert picture[-1, 1].tolist() == list(COLOURS["^"])
