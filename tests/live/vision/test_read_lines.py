"""Reading written lines: the position and the view in each form, and each reason why they are unreadable."""

import pytest

from mc_nested.live.model.reading import Reading, Target
from mc_nested.live.vision.debug_screen import nothing_seen, read_lines, read_position
from mc_nested.live.vision.layout import VANILLA, Overlay
from mc_nested.live.vision.overlay import POSITION, REDUCED
from mc_nested.live.vision.text_lines import UNKNOWN
from tests.live.vision.written_lines import WrittenLines, written

XYZ = "XYZ: -8.500 / 64.00000 / 12345.678"
FACING = "Facing: north (Towards negative Z) (-179.9 / 65.0)"


def said(*texts: str, label: str = POSITION) -> Reading:
    return read_lines(WrittenLines(*(written(text, number) for number, text in enumerate(texts))), label)


def test_position_view_and_block_are_read() -> None:
    reading = said(XYZ, FACING, "Targeted Block: 1, 2, 3", "minecraft:stone")
    assert reading == Reading((-8.5, 64.0, 12345.678), -179.9, 65.0, Target((1, 2, 3), "minecraft:stone"))


def test_the_stand_ins_forms_are_read() -> None:
    reading = said("XYZ: 1,000 / 2,500 / -3.250", "Facing (minecraft): south (towards positive Z) (0.0 65.0)")
    assert reading == Reading((1.0, 2.5, -3.25), 0.0, 65.0, None)


@pytest.mark.parametrize("behind", ["", f" {UNKNOWN}i", " i", UNKNOWN])
def test_text_behind_a_complete_position_is_ignored(behind: str) -> None:
    assert said(XYZ + behind, FACING + behind).xyz == (-8.5, 64.0, 12345.678)


@pytest.mark.parametrize(
    "text",
    [
        "XYZ: -8.50 / 64.00000 / 12345.678",
        "XYZ: -8.500 / 64.0000 / 12345.678",
        "XYZ: -8.500 / 64.00000 / 12345.6789",
        "XYZ: 08.500 / 64.00000 / 12345.678",
        "XYZ: 123456789.500 / 64.00000 / 1.000",
        f"XYZ: -8.5{UNKNOWN}0 / 64.00000 / 12345.678",
    ],
)
def test_a_malformed_position_is_a_problem_and_gives_no_values(text: str) -> None:
    reading = said(text, FACING)
    assert (reading.xyz, reading.yaw, reading.target) == (None, None, None)
    assert (reading.problem or "").startswith("a line reads 'XYZ: ")


@pytest.mark.parametrize(("yaw", "pitch"), [("180.0", "90.0"), ("-180.0", "-90.0")])
def test_the_largest_and_smallest_view_angles_are_read(yaw: str, pitch: str) -> None:
    reading = said(XYZ, f"Facing: north (Towards negative Z) ({yaw} / {pitch})")
    assert (reading.yaw, reading.pitch) == (float(yaw), float(pitch))


@pytest.mark.parametrize(("yaw", "pitch"), [("180.1", "0.0"), ("0.0", "90.1"), ("-180.1", "-90.1")])
def test_a_view_out_of_range_is_a_problem(yaw: str, pitch: str) -> None:
    problem = said(XYZ, f"Facing: north (Towards negative Z) ({yaw} / {pitch})").problem or ""
    assert problem.startswith(f"a yaw of {yaw} with a pitch of {pitch} can't be")


def test_a_missing_facing_line_is_a_problem() -> None:
    assert (said(XYZ).problem or "").startswith("the debug screen shows no Facing line")


def test_read_position_needs_only_the_position_line_and_gives_none_without_it() -> None:
    assert read_position(WrittenLines(written(XYZ, 0))) == (-8.5, 64.0, 12345.678)
    assert read_position(WrittenLines(written("XYZ: 1", 0))) is None
    assert read_position(WrittenLines()) is None


def test_a_reduced_debug_screen_is_named() -> None:
    problem = said("Chunk-relative: 1 2 3", label=REDUCED).problem or ""
    assert problem.startswith("the debug screen is reduced and shows no XYZ")


@pytest.mark.parametrize("title", ["1.20.1", "26.3", "26.4", "27.1"])
def test_a_debug_screen_of_any_version_without_a_position_is_told_how_to_show_it(title: str) -> None:
    problem = said(f"Minecraft {title} (vanilla)", label="Minecraft ").problem or ""
    assert problem.startswith("no XYZ line is to be seen")


@pytest.mark.parametrize("label", ["Section-relative:", "Section-Relative:"])
def test_a_section_line_without_a_position_is_reported_as_reduced(label: str) -> None:
    problem = said(f"{label} 04 04 11", label=label).problem or ""
    assert problem.startswith("the debug screen is reduced and shows no XYZ")
    assert problem.endswith("minecraft:player_position on (F3+F6)")


def test_a_debug_screen_without_title_and_position_is_reported_as_lacking_xyz() -> None:
    assert (said("Facing: north", label="Facing").problem or "").startswith("no XYZ line is to be seen")


def test_the_problem_without_a_debug_screen_names_the_scales_tried() -> None:
    assert "at GUI scale 3: press F3" in (nothing_seen(Overlay(3, VANILLA, (224, 224, 224))).problem or "")
    assert "at a GUI scale from 1 to 8: press F3" in (nothing_seen(None).problem or "")
