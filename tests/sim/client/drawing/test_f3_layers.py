"""The virtual client's debug screen; reading it is left to test_debug_screen.py."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.model.reading import Target
from sim.client.drawing.f3_layers import paint
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS, left_lines, right_lines
from tests.sim.client.playing import FONT

SCREEN = F3Screen("1.8-1.12", 2, (-8.5, 64.0, 100.25), 90.0, 65.0, Target((-9, 63, 101), "minecraft:stone"))


def texts(screen: F3Screen) -> tuple[list[str], list[str]]:
    return [line.text for line in left_lines(screen)], [line.text for line in right_lines(screen)]


def test_the_lines_of_1_12_say_what_the_facts_say() -> None:
    left, right = texts(SCREEN)
    for line in (
        "XYZ: -8.500 / 64.00000 / 100.250",
        "Block: -9 64 100",
        "Chunk: 7 0 4 in -1 4 6",
        "Facing: west (Towards negative X) (90.0 / 65.0)",
        "Looking at: -9 63 101",
    ):
        assert line in left
    assert "minecraft:stone" in right


@pytest.mark.parametrize(
    ("layout", "line"),
    [
        ("1.13-1.15", "Looking at block: -9 63 101"),
        ("1.16-1.19.2", "Targeted Block: -9, 63, 101"),
        ("1.19.3-1.21.8", "Block: -9 64 100 [7 0 4]"),
        ("1.19.3-1.21.8", "Chunk: -1 4 6 [31 6 in r.-1.0.mca]"),
        ("1.21.9-26.3", "Section-relative: 07 00 04"),
        ("standin", "XYZ: -8.500 / 64.000 / 100.250"),
        ("standin", "Facing (minecraft): west (towards negative X) (90.0 65.0)"),
        ("standin", "Looking at: -9 63 101"),
    ],
)
def test_each_layout_has_the_lines_of_its_row(layout: Layout, line: str) -> None:
    left, right = texts(dataclasses.replace(SCREEN, layout=layout))
    assert line in left + right


def test_reduced_debug_info_leaves_no_position() -> None:
    left, right = texts(dataclasses.replace(SCREEN, reduced=True))
    assert "Chunk-relative: 7 0 4" in left
    assert not [line for line in left + right if line.startswith(("XYZ", "Block:", "Facing", "Looking", "minecraft:"))]


@pytest.mark.parametrize("world", [0, 100, 255])
def test_the_first_line_lies_at_its_position_in_a_box(world: int) -> None:
    frame = paint(np.full((480, 854, 3), world, np.uint8), SCREEN, FONT)
    boxed = round(world * (255 - 0x90) / 255 + 0x50 * 0x90 / 255)
    assert (frame[0:2, 0:2] == world).all()
    assert abs(int(frame[2, 2, 0]) - boxed) <= 1
    assert (frame[4:6, 4:6] == 224).all()


@pytest.mark.parametrize("layout", [layout for layout in LAYOUTS if layout != "26.4"])
def test_text_of_the_right_column_ends_at_the_same_column(layout: Layout) -> None:
    screen = dataclasses.replace(SCREEN, layout=layout)
    ink = paint(np.zeros((480, 854, 3), np.uint8), screen, FONT)[::2, ::2, 1] > 200
    edge, pitch = (1, 10) if layout == "standin" else (2, 9)
    tops = [edge + pitch * index for index, line in enumerate(right_lines(screen)) if line.text]
    ends = {int(np.flatnonzero(ink[top - (layout == "standin") : top + 7].any(0))[-1]) for top in tops}
    assert ends == {427 - edge - 2}


def test_the_value_true_is_green_and_the_label_of_the_block_underlined() -> None:
    screen = dataclasses.replace(SCREEN, layout="1.16-1.19.2", properties=(("snowy", "true"),))
    frame = paint(np.zeros((480, 854, 3), np.uint8), screen, FONT)
    assert (frame == (85, 255, 85)).all(2).any()
    lines = [line.text for line in right_lines(screen)]
    top = 2 * (2 + 9 * lines.index("Targeted Block: -9, 63, 101") + 8)
    assert (frame[top : top + 2, 800:848] == 224).all()


def test_the_world_itself_is_left_as_it_is() -> None:
    world = np.zeros((480, 854, 3), np.uint8)
    paint(world, SCREEN, FONT)
    assert not world.any()
