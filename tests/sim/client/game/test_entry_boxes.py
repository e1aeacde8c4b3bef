"""26.4's boxes: what is in them, and which column each stands in."""

import dataclasses

import pytest

from mc_nested.live.model.reading import Target
from sim.client.game.debug_entries import GAME_DEFAULT, known_entries, shown_entries
from sim.client.game.edition import Edition
from sim.client.game.entry_boxes import box_columns, stood_after
from sim.client.game.f3_screen import F3Screen, Stood
from sim.client.game.f3_text import both_columns
from tests.sim.client.f3_lines import left_lines, right_lines

TARGET = Target((4, -61, 11), "minecraft:stone")
SCREEN = F3Screen("26.4", 2, (-12.3, -59.0, -6.011), 58.0, 3.3, TARGET, version="26.4", size=(1920, 1080))
DEFAULT = shown_entries(GAME_DEFAULT, Edition("26.4"), has_f3=True)


def titles(screen: F3Screen) -> list[list[str]]:
    return [[part[0].text for part in column] for column in both_columns(screen)]


def test_the_default_boxes_stand_in_their_preferred_columns() -> None:
    left, right = titles(dataclasses.replace(SCREEN, entries=DEFAULT))
    assert left == ["120 fps T: 120 (fifo) @60Hz", "Position", "Server: Integrated @ 1.2/50.0 ms", "Help"]
    assert right == ["Minecraft 26.4 (26.4/vanilla)", "Memory", "Performance Impactors", "System Specs"]


def test_the_position_and_block_boxes_match_the_facts() -> None:
    lines = [line.text for line in (*left_lines(SCREEN), *right_lines(SCREEN))]
    for line in (
        "XYZ: -12.300 / -59.00000 / -6.011",
        "Block: -13 -59 -7",
        "Chunk: -1 -4 -1 [31 31 in r.-1.-1.mca]",
        "Facing: west (Towards negative X) (58.0 / 3.3)",
        "Dimension: minecraft:overworld",
        "Section-Relative: 03 05 09",
        "Looking At Block",
        "Coordinates: 4, -61, 11",
        "Type: minecraft:stone",
    ):
        assert line in lines
    assert not [line for line in lines if line.startswith("Targeted")]


def test_the_biome_stands_first_in_the_position() -> None:
    lines = [line.text for line in left_lines(dataclasses.replace(SCREEN, entries=("biome", "player_position")))]
    assert lines[:3] == ["Position", "Biome: minecraft:plains", "XYZ: -12.300 / -59.00000 / -6.011"]


def test_a_fluids_and_an_entitys_box_have_the_blocks_labels() -> None:
    entries = ("looking_at_block_state", "looking_at_entity", "looking_at_fluid_state")
    screen = dataclasses.replace(SCREEN, entries=entries, fluid=(1, 2, 3), entity=(0.5, 64.0, 2.5), has_f3=False)
    lines = [line.text for line in (*left_lines(screen), *right_lines(screen))]
    assert len([line for line in lines if line.startswith("Coordinates: ")]) == 3
    assert "Coordinates: 0.50, 64.00, 2.50" in lines


def test_a_screen_without_a_target_block_has_no_box_for_one() -> None:
    assert not [column for column in titles(dataclasses.replace(SCREEN, target=None)) if "Looking At Block" in column]


def test_a_new_box_goes_into_the_left_column_only_if_that_is_shorter() -> None:
    entries = ("looking_at_block_state", "looking_at_fluid_state")
    screen = dataclasses.replace(SCREEN, entries=entries, fluid=(1, 2, 3), has_f3=False)
    assert titles(screen) == [["Looking At Fluid"], ["Looking At Block"]]


def test_a_box_keeps_its_column_and_its_place() -> None:
    stood: Stood = (("Looking At Block",), ("Memory",))
    entries = ("looking_at_block_state", "memory", "player_position")
    left, right = titles(dataclasses.replace(SCREEN, entries=entries, stood=stood))
    assert left[:2] == ["Looking At Block", "Position"]
    assert right[0] == "Memory"


def test_a_target_blocks_box_comes_back_at_the_end_of_a_column() -> None:
    stood = stood_after(dataclasses.replace(SCREEN, target=None), 270)
    left, right = titles(dataclasses.replace(SCREEN, stood=stood, entries=None, gui_scale=4))
    assert "Looking At Block" in (left[-1], right[-1])
    assert "Help" in (left[-2], right[-2], left[-1], right[-1])


@pytest.mark.parametrize("rows", [40, 80, 120, 240, 540])
def test_a_full_column_takes_no_more_boxes(rows: int) -> None:
    entries = tuple(entry for entry in known_entries(Edition("26.4")))
    screen = dataclasses.replace(SCREEN, entries=entries)
    for column in box_columns(screen, rows):
        assert all(placed.top < rows for placed in column)
    again = dataclasses.replace(screen, stood=stood_after(screen, rows))
    assert box_columns(again, rows) == box_columns(screen, rows)


def test_a_box_begins_nine_rows_below_the_box_before() -> None:
    left, _ = box_columns(dataclasses.replace(SCREEN, entries=DEFAULT), 540)
    assert [placed.top for placed in left] == [2, 20, 20 + 9 * 8, 20 + 9 * 11]
