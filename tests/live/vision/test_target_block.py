"""The block looked at, from lines written down: every version's form, and each reason why it is unreadable.

The block looked at as 26.4 shows it: what written-down facts say, and each reason why it is unreadable.
"""

import dataclasses

import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.layout import BOXES
from mc_nested.live.vision.screen_lines import Unreadable
from mc_nested.live.vision.target_block import target_block, target_in_box
from mc_nested.live.vision.text_lines import UNKNOWN, Line
from tests.live.vision.written_lines import RIGHT, WrittenLines, written

STONE = Target((-9, 63, 12), "minecraft:stone")
ID = written("minecraft:stone", 5, right=True)


def of(*lines: Line) -> Target | None:
    return target_block(WrittenLines(*lines))


def why_not(*lines: Line) -> str:
    with pytest.raises(Unreadable) as raised:
        of(*lines)
    return str(raised.value)


def test_1_8_writes_the_position_on_the_left_and_the_id_on_the_right() -> None:
    assert of(written("Looking at: -9 63 12", 9), ID) == STONE


def test_1_13_writes_the_position_on_the_left_and_the_id_below_a_label_on_the_right() -> None:
    assert of(written("Looking at block: -9 63 12", 9), written("Targeted Block", 4, right=True), ID) == STONE


@pytest.mark.parametrize("right", [True, False])
def test_1_16_writes_the_id_below_the_position_in_either_column(right: bool) -> None:
    block = written("minecraft:stone", 5, right=right)
    assert of(written("Targeted Block: -9, 63, 12", 4, right=right), block) == STONE


def test_lines_without_a_block_give_no_target() -> None:
    assert of(written("XYZ: 1.000 / 2.00000 / 3.000", 0)) is None


def test_a_block_of_a_mod_is_found_by_where_its_line_ends() -> None:
    block = written("some-mod:machine/a_2", 7, right=True)
    assert of(written("Looking at: 1 2 3", 9), block) == Target((1, 2, 3), "some-mod:machine/a_2")


def test_a_biome_on_the_left_is_not_taken_for_the_id_of_1_8() -> None:
    assert of(written("Looking at: -9 63 12", 9), written("minecraft:plains", 3), ID) == STONE


@pytest.mark.parametrize("ids", [[], [ID, written("minecraft:dirt", 6, right=True)]])
def test_zero_or_two_ids_on_the_right_of_1_8_are_unreadable(ids: list[Line]) -> None:
    assert f"{len(ids)} lines may be the id" in why_not(written("Looking at: 1 2 3", 9), *ids)


def test_text_behind_a_position_on_the_left_is_ignored() -> None:
    assert of(written(f"Looking at: -9 63 12 {UNKNOWN}i", 9), ID) == STONE


def test_a_position_on_the_right_with_text_behind_it_is_unreadable() -> None:
    label = written("Targeted Block: -9, 63, 12 .", 4, right=True)
    assert "a line reads 'Targeted Block: -9, 63, 12 .'" in why_not(label, ID)


@pytest.mark.parametrize("text", ["Looking at: 1 2", "Looking at: 01 2 3", "Looking at: 1 2 3.5", "Looking at: 1 ? 3"])
def test_a_position_of_another_form_is_not_read(text: str) -> None:
    assert "a line reads" in why_not(written(text, 9), ID)


def test_a_position_whose_end_may_be_covered_is_not_read() -> None:
    assert "the end of 'Looking at: 1 2 3' may be covered" in why_not(written("Looking at: 1 2 3", 9, whole=False), ID)


def test_an_id_whose_end_may_be_covered_is_not_read() -> None:
    covered = dataclasses.replace(ID, whole=False)
    assert "the end of 'minecraft:stone' may be covered" in why_not(
        written("Targeted Block: 1, 2, 3", 4, right=True), covered
    )


def test_an_id_that_is_covered_in_its_middle_is_not_read() -> None:
    label = written("Targeted Block: 1, 2, 3", 4, right=True)
    covered = written(f"minecraft:sto{UNKNOWN}e", 5, right=True)
    assert "a line reads 'minecraft:sto?e'" in why_not(label, covered)


@pytest.mark.parametrize("text", [f"mine{UNKNOWN}raft:stone", "craft:stone", "stone", "raft:stone", "t:stone"])
def test_an_id_of_which_a_part_may_be_covered_is_not_read(text: str) -> None:
    label = written("Targeted Block: 1, 2, 3", 4, right=True)
    assert "the id of the block looked at reads" in why_not(label, written(text, 5, right=True))


def test_specks_left_of_an_id_are_ignored() -> None:
    label = written("Targeted Block: -9, 63, 12", 4, right=True)
    assert of(label, written(f"{UNKNOWN} i minecraft:stone", 5, right=True)) == STONE


def test_text_behind_an_id_on_the_left_is_ignored() -> None:
    label = written("Targeted Block: -9, 63, 12", 4)
    assert of(label, written(f"minecraft:stone {UNKNOWN}", 5)) == STONE


def test_a_label_without_its_id_below_it_is_reported() -> None:
    label = written("Targeted Block: 1, 2, 3", 4, right=True)
    assert "the id below 'Targeted Block' can't be seen" in why_not(label, written("minecraft:stone", 6, right=True))


def test_1_13s_label_without_its_position_is_reported() -> None:
    problem = why_not(written("Targeted Block", 4, right=True), ID)
    assert problem.startswith("the place of the block looked at can't be seen")


def test_1_13s_position_without_its_label_is_reported() -> None:
    assert "the 'Targeted Block' lines" in why_not(written("Looking at block: 1 2 3", 9), ID)


@pytest.mark.parametrize("label", ["Targeted Block: 1, 2, 3", "Looking at: 1 2 3", "Looking at block: 1 2 3"])
def test_two_lines_with_the_same_label_are_unreadable(label: str) -> None:
    assert "2 lines begin with" in why_not(written(label, 4), written(label, 20), ID)


@pytest.mark.parametrize(
    "text",
    ["Targeted Blo", "geted Block: 1, 2, 3", "Looking at b", "oking at block: 1 2 3", "ooking at: 1", "ing at: 1"],
)
def test_half_a_label_is_unreadable(text: str) -> None:
    assert "of the block looked at only" in why_not(written(text, 4))


def test_an_id_without_a_label_over_it_is_unreadable() -> None:
    assert "what 'minecraft:stone' belongs to can't be seen" in why_not(ID)
    assert "what 'minecraft:stone' belongs to can't be seen" in why_not(ID, written("CPU: 4x", 4, right=True))
    assert "belongs to can't be seen" in why_not(written(f"{UNKNOWN}minecraft:stone", 5, right=True))
    assert "belongs to can't be seen" in why_not(written("minecraft:stone", 5))


@pytest.mark.parametrize("label", ["Targeted Fluid: 1, 2, 3", "Targeted Entity"])
@pytest.mark.parametrize("right", [True, False])
def test_an_id_below_an_entitys_label_gives_no_target_and_below_a_fluids_is_unreadable(label: str, right: bool) -> None:
    lines = [written(label, 4, right=right), written("minecraft:lava", 5, right=right)]
    if right:  # aligned where the lines end, not where they begin
        assert lines[0].start != lines[1].start
    if label == "Targeted Entity":
        assert of(*lines) is None
    else:
        assert "a fluid is looked at" in why_not(*lines)


@pytest.mark.parametrize("text", ["Biome: minecraft:plains", "minecraft:overworld FC: 0", "minecraft:the_nether"])
def test_a_biome_or_dimension_is_not_taken_for_a_block(text: str) -> None:
    assert of(written(text, 5)) is None


def test_tags_without_a_label_are_unreadable() -> None:
    tags = written("#minecraft:planks", 8, right=True)
    assert "which block the tags" in why_not(tags)
    assert of(tags, written("Targeted Entity", 4, right=True)) is None


OWN_LINES = [
    written(text, row, right=True) for row, text in enumerate(("Java: 21", "Mem: 2%", "CPU: 4x", "Display: 2x2"))
]


@pytest.mark.parametrize("title", ["Minecraft 1.12.2 (1.12.2/vanilla)", "Minecraft 1.21.8 (x)", "Minecraft 25w31a"])
def test_up_to_1_21_8_no_target_is_reported_only_with_all_right_column_lines_seen(title: str) -> None:
    assert of(written(title, 0), *OWN_LINES) is None
    for covered in range(len(OWN_LINES)):
        rest = [line for row, line in enumerate(OWN_LINES) if row != covered]
        assert "a notice may lie over the lines" in why_not(written(title, 0), *rest)
    assert "a notice may lie over the lines" in why_not(written(title, 0), written("Java: 21", 20), *OWN_LINES[1:])


@pytest.mark.parametrize("title", ["Minecraft 1.21.9 (x)", "Minecraft 26.1 (26.1/vanilla)"])
def test_from_1_21_9_on_the_right_column_may_lack_any_line(title: str) -> None:
    assert of(written(title, 0)) is None


def test_a_possible_notice_makes_the_target_unreadable() -> None:
    with pytest.raises(Unreadable, match="a notice may lie over"):
        target_block(WrittenLines(*OWN_LINES, is_covered=True))


def test_written_lines_on_the_right_end_at_the_same_column() -> None:
    assert ID.end == written("Targeted Block: 1, 2, 3", 4, right=True).end == RIGHT


PLAYER = (4.5, -60.0, 11.5)
TITLE, PLACE, KIND = "Looking At Block", "Coordinates: 4, -61, 11", "Type: minecraft:stone"


def said(*texts: str, whole: bool = True, is_covered: bool = False) -> Target | None:
    lines = [written(text, number, whole=whole) for number, text in enumerate(texts)]
    return target_in_box(WrittenLines(*lines, layout=BOXES, is_covered=is_covered), PLAYER)


def test_the_target_is_read_from_the_boxs_coordinates_and_type() -> None:
    assert said(TITLE, PLACE, KIND, "axis: y") == Target((4, -61, 11), "minecraft:stone")
    assert said(TITLE, PLACE, "Type: some-mod:machine/casing_2") == Target((4, -61, 11), "some-mod:machine/casing_2")


def test_lines_without_a_blocks_box_give_no_target() -> None:
    assert said("Position", "XYZ: 4.500 / -60.00000 / 11.500") is None


@pytest.mark.parametrize("title", ["Looking At Fluid", "Looking At Entity"])
def test_the_box_of_a_fluid_or_an_entity_is_not_taken_for_a_block(title: str) -> None:
    assert said(title, PLACE, "Type: minecraft:water") is None


@pytest.mark.parametrize(
    ("texts", "reason"),
    [
        ((TITLE, TITLE, PLACE, KIND), "2 lines begin with"),
        ((TITLE, "#minecraft:logs"), "switch minecraft:looking_at_block_state on"),
        ((TITLE, PLACE), "no Type can be seen"),
        ((TITLE, "Coordinates: 4, -61", KIND), "a line reads 'Coordinates: 4, -61'"),
        ((TITLE, PLACE, "Type: stone"), "a line reads 'Type: stone'"),
        ((TITLE, "Coordinates: 400, -61, 11", KIND), "can be looked at from where the player is"),
        (("Looking At B",), "only 'Looking At B' can be seen"),
        (("king At Block",), "only"),
        ((PLACE, KIND), "belongs to can't be seen"),
        (("Position", PLACE, KIND), "belongs to can't be seen"),
    ],
)
def test_an_incomplete_or_implausible_box_is_unreadable(texts: tuple[str, ...], reason: str) -> None:
    with pytest.raises(Unreadable, match=reason):
        said(*texts)


def test_a_type_whose_end_may_be_covered_is_unreadable() -> None:
    with pytest.raises(Unreadable, match="may be covered"):
        said(TITLE, PLACE, KIND, whole=False)


def test_full_columns_without_a_box_are_unreadable() -> None:
    with pytest.raises(Unreadable, match="both columns of the debug screen are full"):
        said("Position", is_covered=True)
