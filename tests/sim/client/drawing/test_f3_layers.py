"""The virtual client's debug screen; reading it is left to test_debug_screen.py.

26.4's boxes, drawn: positions and colours of the facts, in GUI pixels.
"""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import Letters
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from tests.sim.client.f3_lines import left_lines, right_lines
from tests.sim.client.playing import FONT

SCREEN = F3Screen("1.8-1.12", 2, (-8.5, 64.0, 100.25), 90.0, 65.0, Target((-9, 63, 101), "minecraft:stone"))


def texts(screen: F3Screen) -> tuple[list[str], list[str]]:
    return [line.text for line in left_lines(screen)], [line.text for line in right_lines(screen)]


def test_the_lines_of_1_12_match_the_facts() -> None:
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
def test_each_layout_writes_the_lines_of_its_versions(layout: Layout, line: str) -> None:
    left, right = texts(dataclasses.replace(SCREEN, layout=layout))
    assert line in left + right


def test_reduced_debug_info_hides_the_position() -> None:
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


def test_painting_does_not_change_the_given_world() -> None:
    world = np.zeros((480, 854, 3), np.uint8)
    paint(world, SCREEN, FONT)
    assert not world.any()


BOXED_SCREEN = F3Screen("26.4", 1, (0.5, 64.0, 0.5), 0.0, 0.0, version="26.4", has_f3=False, size=(427, 240))
LETTERS = Letters(FONT, 1)
WHITE, BRIGHT, GLUE = (255, 255, 255), (224, 224, 224), (208, 208, 208)


def painted(screen: F3Screen, world: int = 0) -> Frame:
    return paint(np.full((240, 427, 3), world, np.uint8), screen, FONT)


def ink(frame: Frame, colour: tuple[int, int, int], rows: tuple[int, int]) -> list[int]:
    """Return the columns in which a colour stands between two rows."""
    first, behind = rows
    found = (frame[first:behind] == colour[::-1]).all(2)
    return [int(column) for column in np.flatnonzero(found.any(0))]


def test_a_boxs_title_begins_at_6_and_its_names_are_aligned_on_the_right() -> None:
    frame = painted(dataclasses.replace(BOXED_SCREEN, entries=("player_position",)))
    names = ("XYZ", "Block", "Chunk", "Facing", "Dimension")
    widest = max(map(LETTERS.width, names))
    assert min(ink(frame, WHITE, (2, 10))[1:]) == 3 + 3
    for row, name in enumerate(names, 1):
        columns = ink(frame, BRIGHT, (2 + 9 * row, 10 + 9 * row))
        assert min(columns) == 3 + widest - LETTERS.width(name)
        # The colon stands behind the column of names.
        assert max(columns) == 3 + widest
        assert min(ink(frame, WHITE, (2 + 9 * row, 10 + 9 * row))[1:]) == 3 + widest + 5


def test_commas_between_values_are_darker_and_true_and_false_are_coloured() -> None:
    target = Target((4, -61, 11), "minecraft:stone")
    screen = dataclasses.replace(BOXED_SCREEN, target=target, properties=(("lit", "true"), ("wet", "false")))
    frame = painted(dataclasses.replace(screen, entries=("looking_at_block_state",)))
    assert len(ink(frame, GLUE, (11, 19))) == 2 * 2  # two commas
    assert not ink(frame, GLUE, (20, 28))
    assert ink(frame, (0, 255, 0), (29, 37))
    assert ink(frame, (255, 0, 0), (38, 46))


def test_a_boxs_grounds_reach_one_pixel_beyond_its_text_and_the_titles_is_darker() -> None:
    frame = painted(dataclasses.replace(BOXED_SCREEN, entries=("player_section_position",)), 200)
    title, facts = (round(200 * 111 / 255 + grey * 144 / 255) for grey in (48, 80))
    width = LETTERS.width("Section-Relative") + 5 + LETTERS.width("00 00 00")
    for row, grey in ((1, title), (9, title), (10, facts), (20, facts)):
        assert abs(int(frame[row, 2, 0]) - grey) <= 1
        assert abs(int(frame[row, 3 + width, 0]) - grey) <= 1
        assert (frame[row, [1, 4 + width]] == 200).all()
    assert (frame[[0, 21], 2] == 200).all()


def test_a_bar_of_its_colour_lies_beside_a_box_at_the_windows_edge() -> None:
    frame = painted(dataclasses.replace(BOXED_SCREEN, entries=("memory", "player_position")), 10)
    assert (frame[1:57, 0] == 255).all()
    assert (frame[57, 0] == 10).all()
    assert (frame[1:39, 426] == (0, 155, 255)).all()
    assert (frame[39, 426] == 10).all()


def test_right_boxes_end_three_pixels_before_the_edge_and_lines_have_no_bar() -> None:
    frame = painted(dataclasses.replace(BOXED_SCREEN, entries=("fps", "game_version")))
    assert min(ink(frame, BRIGHT, (2, 10))) == 3
    assert max(ink(frame, BRIGHT, (2, 10))) == 427 - 3 - 2
    assert not frame[:, [0, 426]].any()


def test_lines_below_a_boxs_facts_are_two_pixels_lower() -> None:
    screen = dataclasses.replace(BOXED_SCREEN, entries=("system_specs",))
    frame = painted(screen)
    assert not (frame[[47, 48]] == 224).any()
    assert (frame[49:57] == 224).any()


def test_an_unchanged_box_is_drawn_as_the_same_layer() -> None:
    from sim.client.drawing.f3_layers import F3Layers

    layers = F3Layers(LETTERS, (427, 240))
    moved = dataclasses.replace(BOXED_SCREEN, xyz=(0.7, 64.0, 0.5))
    one, other = (layers.of(screen) for screen in (BOXED_SCREEN, moved))
    assert [layer in other for layer in one].count(False) == 1
