"""The debug screen from 1.21.9 to 26.3, beside what stands on two real screens of it."""

import dataclasses
from itertools import chain

import pytest

from mc_nested.live.model.reading import Target
from sim.client.game.debug_entries import GAME_DEFAULT, known_entries, shown_entries
from sim.client.game.edition import Edition
from sim.client.game.entry_lines import entry_columns
from sim.client.game.f3_screen import F3Screen

TARGET = Target((17, -63, -33), "minecraft:oak_log")
SCREEN = F3Screen("1.21.9-26.3", 4, (4.3, -60.0, 11.955), 98.3, 16.7, TARGET, version="26.1")

SYSTEM = ("Java: ", "CPU: ", "Display: ", "*", "*")
POSITION = ("XYZ: ", "Block: ", "Chunk: ", "Facing: ", "minecraft:overworld FC: ", "Section-relative: ")
REAL_LEFT: dict[str, tuple[str, ...]] = {
    "1.21.11": (
        *("* fps T: ", "", " fancy-clouds B: ", "Filtering: ", "", "Mem: ", "Allocation rate: ", "Allocated: ", ""),
        *(*POSITION, "", "", "Debug charts: [F3+1] Profiler hidden; [F3+2] FPS + TPS hidden; [F3+3] Ping hidden"),
        "To edit: press [F3+F6]",
    ),
    "26.1": (
        *("* fps T: ", "", "* fancy-clouds B: ", "Filtering: ", "", "Mem: ", "Allocation rate: ", "Allocated: ", ""),
        *(*POSITION, "", "", "Debug charts: [F3+1] Profiler hidden; [F3+2] FPS + TPS hidden;"),
        *("[F3+3] Ping hidden; [F3+4] Lightmap hidden", "To edit: press [F3+F6]"),
    ),
}
"""The left columns of the two real screens, both of the default entries: how each row begins, * for what differs."""

REAL_RIGHT: dict[str, tuple[str, ...]] = {
    version: (f"Minecraft {version} (", "", "Integrated server @ ", "", *SYSTEM) for version in ("1.21.11", "26.1")
}
"""Their right columns."""


def columns(**more: object) -> tuple[list[str], list[str]]:
    left, right = entry_columns(dataclasses.replace(SCREEN, **more))  # type: ignore[arg-type]  # mixed fields
    return [line.text for line in chain(*left)], [line.text for line in chain(*right)]


def begins(line: str, how: str) -> bool:
    return bool(line) if how == "*" else line.startswith(how) if how[:1] != "*" else how[1:] in line


@pytest.mark.parametrize("version", ["1.21.11", "26.1"])
def test_the_default_screen_has_the_rows_of_a_real_one(version: str) -> None:
    shown = shown_entries(GAME_DEFAULT, Edition(version), has_f3=True)
    for drawn, real in zip(columns(version=version, entries=shown), (REAL_LEFT, REAL_RIGHT), strict=True):
        rows = drawn if drawn[-1] else drawn[:-1]
        assert len(rows) == len(real[version])
        for line, how in zip(rows, real[version], strict=True):
            assert bool(line) == bool(how)
            assert begins(line, how), (line, how)
    assert ("MiB" in str(columns(version=version))) == (version == "26.1")


def test_the_target_block_stands_left_above_the_memory_and_the_position_on_the_right() -> None:
    left, right = columns()
    assert left[5:9] == ["Targeted Block: 17, -63, -33", "minecraft:oak_log", "", "Mem: 23% 480/2048MiB"]
    assert right[4].startswith("XYZ: ")
    assert right[11].startswith("Java: ")


def test_a_group_without_lines_still_counts_for_the_columns() -> None:
    left, right = columns(target=None)
    assert left[5].startswith("Mem: ")
    assert right[4].startswith("XYZ: ")


def test_two_entries_stand_beside_each_other_at_the_top_without_f3() -> None:
    left, right = columns(entries=("looking_at_block_state", "player_position"), has_f3=False)
    assert left == ["Targeted Block: 17, -63, -33", "minecraft:oak_log", ""]
    assert [line[:4] for line in right] == ["XYZ:", "Bloc", "Chun", "Faci", "mine", ""]
    with_f3, _ = columns(entries=("looking_at_block_state", "player_position"))
    assert with_f3[3:5] == ["", "Debug charts: [F3+1] Profiler hidden; [F3+2] FPS + TPS hidden;"]


def test_a_debug_profile_without_entries_shows_no_lines() -> None:
    assert columns(entries=()) == ([], [])


def test_the_middle_one_of_an_odd_number_of_single_lines_stands_left() -> None:
    left, right = columns(entries=("biome", "day_count", "tps"), has_f3=False)
    assert (left, right) == (
        ["Biome: minecraft:plains", "Day: 3", ""],
        ["Integrated server @ 1.2/50.0 ms, 27 tx, 41 rx", ""],
    )


def test_a_single_priority_line_stands_left() -> None:
    assert columns(entries=("game_version",), has_f3=False) == (["Minecraft 26.1 (26.1/vanilla)", ""], [])


@pytest.mark.parametrize(("version", "is_there"), [("1.21.11", True), ("26.1", False)])
def test_the_tags_belong_to_the_block_to_1_21_11(version: str, is_there: bool) -> None:
    entry = "looking_at_block_state" if version == "26.1" else "looking_at_block"
    left, _ = columns(version=version, tags=("minecraft:logs",), entries=(entry,))
    assert ("#minecraft:logs" in left) is is_there
    with_tags, _ = columns(tags=("minecraft:logs",), entries=("looking_at_block_state", "looking_at_block_tags"))
    assert with_tags[:3] == ["Targeted Block: 17, -63, -33", "minecraft:oak_log", "#minecraft:logs"]


def test_labels_are_underlined_and_true_and_false_have_colours() -> None:
    (block, _, *_), _ = entry_columns(
        dataclasses.replace(SCREEN, properties=(("axis", "y"), ("lit", "true")), entries=("looking_at_block_state",))
    )
    assert [line.underlined for line in block] == [True, False, False, False]
    assert [line.value for line in block] == ["", "", "", "true"]


def test_reduced_debug_info_keeps_the_section_line_and_hides_the_position() -> None:
    left, right = columns(entries=None, reduced=True)
    lines = left + right
    assert "Section-relative: 04 04 11" in lines
    assert not [line for line in lines if line.startswith(("XYZ", "Facing", "Targeted"))]


@pytest.mark.parametrize(
    ("version", "charts", "edit"),
    [
        ("1.21.10", "FPS + TPS hidden; [F3+3] Ping hidden", "To edit: press F3 + F6. For help: press F3 + Q"),
        ("26.3", "fps + tps hidden;", "To edit: press [F3+F6]"),
    ],
)
def test_the_last_lines_name_the_keys_in_the_versions_words(version: str, charts: str, edit: str) -> None:
    left, _ = columns(version=version)
    assert left[-1] == edit
    assert [line for line in left if line.startswith("Debug charts: ") and line.endswith(charts)]


@pytest.mark.parametrize("version", ["1.21.9", "26.3"])
def test_every_entry_that_a_version_knows_can_be_shown(version: str) -> None:
    for entry in known_entries(Edition(version)):
        left, right = columns(version=version, entries=(entry,), fluid=(1, 2, 3), entity=(0.5, 64.0, 2.5), has_f3=False)
        assert all(column == [] or column[-1] == "" for column in (left, right))
