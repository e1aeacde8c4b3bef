"""The findings beside a profile are read back unchanged; each step keeps its newest, and no unused file stays."""

from pathlib import Path

import numpy as np
import pytest

from calibration.context import ReportPicture, StepResult
from calibration.doctor.check import Check, CheckName
from calibration.report.findings import (
    CheckFinding,
    Findings,
    StepFindings,
    findings_folder,
    load_findings,
    save_findings,
)
from mc_nested.errors import ProfileError
from mc_nested.live.profile.tables import Profile

GREY = np.full((3, 4, 3), 99, np.uint8)
RED = np.full((2, 2, 3), (0, 0, 255), np.uint8)


@pytest.fixture
def profile(tmp_path: Path) -> Path:
    return tmp_path / "mine.toml"


def found(step: str, *lines: str, pictures: tuple[ReportPicture, ...] = ()) -> StepResult:
    return StepResult(step, Profile(), lines, len(lines), pictures)


def test_saved_findings_are_loaded_as_they_were(profile: Path) -> None:
    font = found("font", "scale 2", pictures=(ReportPicture("grey", GREY, "all over"), ReportPicture("red", RED)))
    save_findings(profile, [font, found("cross-check")], [Check(CheckName.CLIPBOARD, "skip", "none")], "2026-11-21")
    kept = load_findings(profile)
    assert kept.checks == (CheckFinding(name="clipboard", status="skip", detail="none", fix=""),)
    assert kept.checked == "2026-11-21"
    assert [(step.step, step.date, step.lines, step.samples) for step in kept.steps] == [
        ("font", "2026-11-21", ("scale 2",), 1),
        ("cross-check", "2026-11-21", (), 0),
    ]
    grey, red = kept.steps[0].pictures
    assert (grey.title, grey.note, red.title, red.note) == ("grey", "all over", "red", "")
    assert np.array_equal(grey.frame, GREY)
    assert np.array_equal(red.frame, RED)


def test_a_repeated_step_replaces_the_old_one_and_its_pictures(profile: Path) -> None:
    two = (ReportPicture("one", GREY), ReportPicture("two", GREY))
    save_findings(
        profile, [found("font", "old", pictures=two), found("walk", "slow", pictures=two[:1])], today="2026-11-20"
    )
    save_findings(profile, [found("font", "new", pictures=(ReportPicture("red", RED),))], today="2026-11-21")
    font, walk = load_findings(profile).steps
    assert (font.lines, font.date, walk.lines, walk.date) == (("new",), "2026-11-21", ("slow",), "2026-11-20")
    assert np.array_equal(font.pictures[0].frame, RED)
    left = {file.name for file in findings_folder(profile).iterdir()}
    assert left == {"found.json", "font-1.png", "walk-1.png"}


def test_the_doctors_table_stays_until_there_is_a_new_one(profile: Path) -> None:
    save_findings(profile, [], [Check(CheckName.WINDOW, "fail", "none", "start the game")], "2026-11-20")
    save_findings(profile, [found("font")], today="2026-11-21")
    kept = load_findings(profile)
    assert (kept.checked, [check.status for check in kept.checks]) == ("2026-11-20", ["fail"])


def test_profile_that_was_never_calibrated_has_no_findings(tmp_path: Path) -> None:
    assert load_findings(tmp_path / "mine.toml") == Findings()


def test_a_picture_that_is_gone_is_left_out(profile: Path) -> None:
    save_findings(profile, [found("font", "a line", pictures=(ReportPicture("grey", GREY),))], today="2026-11-21")
    (findings_folder(profile) / "font-1.png").unlink()
    assert load_findings(profile).steps == (StepFindings("font", "2026-11-21", ("a line",), 1, ()),)


@pytest.mark.parametrize(
    "text", ["{", "[]", '{"steps": [{"step": 3}]}', '{"checks": [{"name": "a", "status": "odd", "detail": ""}]}']
)
def test_a_damaged_list_is_a_one_line_error_that_says_what_to_do(profile: Path, text: str) -> None:
    save_findings(profile, [], today="2026-11-21")
    (findings_folder(profile) / "found.json").write_text(text)
    with pytest.raises(ProfileError, match="remove that folder, and calibrate again"):
        load_findings(profile)


def test_list_that_names_a_file_outside_its_folder_is_refused(profile: Path) -> None:
    save_findings(profile, [found("font", pictures=(ReportPicture("grey", GREY),))], today="2026-11-21")
    path = findings_folder(profile) / "found.json"
    path.write_text(path.read_text().replace("font-1.png", "../font-1.png"))
    with pytest.raises(ProfileError):
        load_findings(profile)


def test_a_folder_that_can_not_be_made_is_a_one_line_error(tmp_path: Path) -> None:
    (tmp_path / "mine-calibration").write_text("a file")
    with pytest.raises(ProfileError):
        save_findings(tmp_path / "mine.toml", [found("font")])
