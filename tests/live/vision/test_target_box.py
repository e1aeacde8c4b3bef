"""The block looked at as 26.4 shows it: what written-down facts say, and each reason why it is unreadable."""

import pytest

from mc_nested.live.model.reading import Target
from mc_nested.live.vision.layout import BOXES
from mc_nested.live.vision.screen_lines import Unreadable
from mc_nested.live.vision.target_box import target_in_box
from tests.live.vision.written_lines import WrittenLines, written

PLAYER = (4.5, -60.0, 11.5)
TITLE, PLACE, KIND = "Looking At Block", "Coordinates: 4, -61, 11", "Type: minecraft:stone"


def said(*texts: str, whole: bool = True, is_covered: bool = False) -> Target | None:
    lines = [written(text, number, whole=whole) for number, text in enumerate(texts)]
    return target_in_box(WrittenLines(*lines, layout=BOXES, is_covered=is_covered), PLAYER)


def test_coordinates_and_type_are_the_target() -> None:
    assert said(TITLE, PLACE, KIND, "axis: y") == Target((4, -61, 11), "minecraft:stone")
    assert said(TITLE, PLACE, "Type: some-mod:machine/casing_2") == Target((4, -61, 11), "some-mod:machine/casing_2")


def test_without_a_box_no_block_is_looked_at() -> None:
    assert said("Position", "XYZ: 4.500 / -60.00000 / 11.500") is None


@pytest.mark.parametrize("title", ["Looking At Fluid", "Looking At Entity"])
def test_the_box_of_something_else_is_no_block(title: str) -> None:
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
def test_what_isnt_sure_is_unreadable(texts: tuple[str, ...], reason: str) -> None:
    with pytest.raises(Unreadable, match=reason):
        said(*texts)


def test_a_type_whose_end_may_be_covered_is_unreadable() -> None:
    with pytest.raises(Unreadable, match="may be covered"):
        said(TITLE, PLACE, KIND, whole=False)


def test_full_columns_leave_it_open_whether_a_block_is_looked_at() -> None:
    with pytest.raises(Unreadable, match="both columns of the debug screen are full"):
        said("Position", is_covered=True)
