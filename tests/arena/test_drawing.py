"""The arena from above as text: which sign each cell gets."""

import dataclasses

import pytest

from mc_nested.arena.drawing import draw_text, kind_of
from mc_nested.arena.scenario import Material, Scenario
from tests.arena.made_parts import STRIPES

PAIR = Scenario("pair", frozenset({(6, 14), (7, 14)}), (7, 12), 9, (Material("stone", 1.0, "stone"),))


def test_each_kind_of_cell_has_its_sign() -> None:
    placed = {(7, 14), (0, 3)}
    signs = {cell: kind_of(PAIR, (7, 13), placed, cell) for cell in [(7, 13), (7, 14), (0, 3), (6, 14), (9, 9)]}
    assert signs == {(7, 13): "^", (7, 14): "#", (0, 3): "x", (6, 14): "o", (9, 9): "."}


def test_with_parts_a_cell_to_build_has_its_parts_number() -> None:
    assert draw_text(STRIPES, (1, 1), {(1, 3), (3, 2)}).splitlines() == [
        ". . . . .",
        ". # 1 . .",
        ". 2 2 # .",
        ". ^ . . .",
        ". . . . .",
    ]


def test_without_an_agent_none_is_drawn_and_the_far_edge_is_on_top() -> None:
    lines = draw_text(PAIR, None, {(7, 14)}).splitlines()
    assert len(lines) == 15
    assert lines[0] == ". . . . . . o # . . . . . . ."
    assert not any("^" in line for line in lines)


@pytest.mark.parametrize("size", [8, 32])
def test_an_arena_is_drawn_as_large_as_it_is(size: int) -> None:
    corner = dataclasses.replace(PAIR, design=frozenset({(size - 1, size - 1)}), start=(0, 0), size=size)
    lines = draw_text(corner, (0, 0), ()).splitlines()
    assert [len(line.split()) for line in lines] == [size] * size
    assert (lines[0].split()[-1], lines[-1].split()[0]) == ("o", "^")
