"""26.4's boxes, drawn: positions and colours of today's facts, in GUI pixels."""

import dataclasses

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.letters import Letters
from sim.client.game.f3_screen import F3Screen
from tests.sim.client.playing import FONT

SCREEN = F3Screen("26.4", 1, (0.5, 64.0, 0.5), 0.0, 0.0, version="26.4", has_f3=False, size=(427, 240))
LETTERS = Letters(FONT, 1)
WHITE, BRIGHT, GLUE = (255, 255, 255), (224, 224, 224), (208, 208, 208)


def painted(screen: F3Screen, world: int = 0) -> Frame:
    return paint(np.full((240, 427, 3), world, np.uint8), screen, FONT)


def ink(frame: Frame, colour: tuple[int, int, int], rows: tuple[int, int]) -> list[int]:
    """The columns in which a colour stands between two rows."""
    first, behind = rows
    found = (frame[first:behind] == colour[::-1]).all(2)
    return [int(column) for column in np.flatnonzero(found.any(0))]


def test_the_title_stands_at_six_and_names_end_where_the_widest_does() -> None:
    frame = painted(dataclasses.replace(SCREEN, entries=("player_position",)))
    names = ("XYZ", "Block", "Chunk", "Facing", "Dimension")
    widest = max(map(LETTERS.width, names))
    assert min(ink(frame, WHITE, (2, 10))[1:]) == 3 + 3
    for row, name in enumerate(names, 1):
        columns = ink(frame, BRIGHT, (2 + 9 * row, 10 + 9 * row))
        assert min(columns) == 3 + widest - LETTERS.width(name)
        # The colon stands behind the column of names.
        assert max(columns) == 3 + widest
        assert min(ink(frame, WHITE, (2 + 9 * row, 10 + 9 * row))[1:]) == 3 + widest + 5


def test_what_stands_between_values_is_darker_and_true_and_false_have_colours() -> None:
    target = Target((4, -61, 11), "minecraft:stone")
    screen = dataclasses.replace(SCREEN, target=target, properties=(("lit", "true"), ("wet", "false")))
    frame = painted(dataclasses.replace(screen, entries=("looking_at_block_state",)))
    assert len(ink(frame, GLUE, (11, 19))) == 2 * 2  # two commas
    assert not ink(frame, GLUE, (20, 28))
    assert ink(frame, (0, 255, 0), (29, 37))
    assert ink(frame, (255, 0, 0), (38, 46))


def test_grounds_reach_one_pixel_further_and_the_title_has_its_own() -> None:
    frame = painted(dataclasses.replace(SCREEN, entries=("player_section_position",)), 200)
    title, facts = (round(200 * 111 / 255 + grey * 144 / 255) for grey in (48, 80))
    width = LETTERS.width("Section-Relative") + 5 + LETTERS.width("00 00 00")
    for row, grey in ((1, title), (9, title), (10, facts), (20, facts)):
        assert abs(int(frame[row, 2, 0]) - grey) <= 1
        assert abs(int(frame[row, 3 + width, 0]) - grey) <= 1
        assert (frame[row, [1, 4 + width]] == 200).all()
    assert (frame[[0, 21], 2] == 200).all()


def test_a_bar_of_its_colour_lies_beside_a_box_at_the_windows_edge() -> None:
    frame = painted(dataclasses.replace(SCREEN, entries=("memory", "player_position")), 10)
    assert (frame[1:57, 0] == 255).all()
    assert (frame[57, 0] == 10).all()
    assert (frame[1:39, 426] == (0, 155, 255)).all()
    assert (frame[39, 426] == 10).all()


def test_right_boxes_end_three_pixels_before_the_edge_and_lines_have_no_bar() -> None:
    frame = painted(dataclasses.replace(SCREEN, entries=("fps", "game_version")))
    assert min(ink(frame, BRIGHT, (2, 10))) == 3
    assert max(ink(frame, BRIGHT, (2, 10))) == 427 - 3 - 2
    assert not frame[:, [0, 426]].any()


def test_lines_below_facts_stand_two_pixels_lower() -> None:
    screen = dataclasses.replace(SCREEN, entries=("system_specs",))
    frame = painted(screen)
    assert not (frame[[47, 48]] == 224).any()
    assert (frame[49:57] == 224).any()


def test_a_box_that_did_not_change_is_the_same_layer() -> None:
    from sim.client.drawing.f3_layers import F3Layers

    layers = F3Layers(LETTERS, (427, 240))
    moved = dataclasses.replace(SCREEN, xyz=(0.7, 64.0, 0.5))
    one, other = (layers.of(screen) for screen in (SCREEN, moved))
    assert [layer in other for layer in one].count(False) == 1
