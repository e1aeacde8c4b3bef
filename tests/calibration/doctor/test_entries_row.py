"""The row of debug-profile.json: the installed version's entries, and those that were seen on the screen."""

from pathlib import Path

import pytest

from calibration.doctor.check import FIX, Check, CheckName, Status
from calibration.doctor.entries_row import entries_row, installed_version, target_row_by_entries
from calibration.installation.folders import GameFolder
from calibration.installation.options_txt import OptionsTxt, parse_options

PRESS = f"press F3+F6 in the game, and set looking_at_block_state to In Overlay; or {FIX}"


def folder(path: Path, text: str | None = None, version: str | None = None) -> GameFolder:
    if text is not None:
        (path / "debug-profile.json").write_text(text, "utf-8")
    return GameFolder(path, "a launcher", version)


def row(path: Path, text: str | None, version: str | None = "26.3") -> Check:
    return entries_row(folder(path, text), version, {})[1]


def test_entries_row_names_the_entries_that_are_on_or_those_that_are_off_with_a_fix(tmp_path: Path) -> None:
    on = '{"custom":{"player_position":"alwaysOn","looking_at_block_state":"inOverlay"}}'
    assert row(tmp_path, on) == Check(
        CheckName.DEBUG_ENTRIES, "pass", "player_position and looking_at_block_state are on"
    )
    off = row(tmp_path, on.replace("inOverlay", "never"))
    assert (off.status, off.detail, off.fix) == ("fail", "looking_at_block_state is off", PRESS)
    both = row(tmp_path, "{}")
    assert both.detail == "player_position and looking_at_block_state are off"


def test_without_a_debug_profile_file_the_default_entries_apply(tmp_path: Path) -> None:
    found = row(tmp_path, None, "1.21.11")
    assert (found.status, found.detail) == ("fail", "looking_at_block is off, since the default entries are shown")
    assert "set looking_at_block to In Overlay" in found.fix


def test_damaged_debug_profile_is_reported_with_its_fix(tmp_path: Path) -> None:
    found = row(tmp_path, "{")
    path = tmp_path / "debug-profile.json"
    assert found.detail == f"{path} is damaged, it is no JSON: the game will replace it by its default entries"
    assert found.fix == "close the game and run mc-nested doctor --fix"


def test_a_version_without_entries_passes_and_an_unknown_one_is_skipped(tmp_path: Path) -> None:
    assert row(tmp_path, None, "1.21.8").status == "pass"
    assert row(tmp_path, None, None).status == "skip"
    assert entries_row(None, "26.3", {})[1].status == "skip"


def test_unreadable_debug_profile_fails_its_row(tmp_path: Path) -> None:
    (tmp_path / "debug-profile.json").mkdir()
    assert row(tmp_path, None).status == "fail"


def test_entries_seen_on_the_screen_pass_whatever_the_file_says(tmp_path: Path) -> None:
    seen = {name: Check(name, "pass", "") for name in (CheckName.POSITION_LINE, CheckName.TARGET_LINE)}
    profile, check = entries_row(folder(tmp_path), "26.3", seen)
    assert check.status == "pass"
    assert target_row_by_entries(profile, {**seen, check.name: check}) is None


@pytest.mark.parametrize(("status", "is_told"), [("skip", True), ("fail", True), ("pass", False)])
def test_looked_at_row_names_the_entry_that_is_off_if_no_block_was_seen(
    status: Status, is_told: bool, tmp_path: Path
) -> None:
    known = {CheckName.TARGET_LINE: Check(CheckName.TARGET_LINE, status, "")}
    profile, check = entries_row(folder(tmp_path), "26.3", known)
    told = target_row_by_entries(profile, {**known, check.name: check})
    assert (told is not None) == is_told
    if told:
        assert (told.status, told.detail, told.fix) == ("fail", "its entry looking_at_block_state is off", PRESS)


def test_position_entry_that_is_off_does_not_change_the_looked_at_row(tmp_path: Path) -> None:
    text = '{"custom":{"player_position":"never","looking_at_block_state":"inOverlay"}}'
    profile, check = entries_row(folder(tmp_path, text), "26.3", {})
    known = {CheckName.TARGET_LINE: Check(CheckName.TARGET_LINE, "skip", ""), check.name: check}
    assert check.status == "fail"
    assert target_row_by_entries(profile, known) is None


def options(data_version: str) -> OptionsTxt:
    return parse_options(f"version:{data_version}\nlang:en_us\n".encode(), Path("options.txt"))


@pytest.mark.parametrize(
    ("in_title", "of_folder", "of_options", "calibrated", "found"),
    [
        ("1.20.1", "26.1", options("5023"), "1.21.10", "1.20.1"),
        (None, "1.21.10", options("5023"), "1.20.1", "1.21.10"),
        (None, "25w41a", options("4671"), "1.20.1", "1.21.11"),
        (None, None, options("5023"), "1.20.1", "26.1"),
        (None, None, options("new"), "1.20.1", "1.20.1"),
        (None, None, None, None, None),
    ],
)
def test_installed_version_comes_from_title_then_folder_then_options_then_profile(
    in_title: str | None,
    of_folder: str | None,
    of_options: OptionsTxt | None,
    calibrated: str | None,
    found: str | None,
) -> None:
    launched = GameFolder(Path("game"), "a launcher", of_folder) if of_folder else None
    assert installed_version(in_title, launched, of_options, calibrated) == found
