"""``mc-nested calibrate report`` writes the report and prints its contents; mistakes are refused in one line."""

from pathlib import Path

import numpy as np
import pytest

from calibration.context import ReportPicture, StepResult
from calibration.report.findings import save_findings
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile, ScreenTable
from tests.cli.running import run

REPORT = ("calibrate", "report", "--profile")


@pytest.fixture
def profile(tmp_path: Path) -> Path:
    path = tmp_path / "mine.toml"
    font = str(Path.home() / ".minecraft" / "1.20.1.jar")
    save_profile(Profile(screen=ScreenTable(font=font)), path)
    picture = ReportPicture("The debug screen", np.zeros((2, 2, 3), np.uint8))
    save_findings(path, [StepResult("font", Profile(), (f"font of {font}",), 1, (picture,))], today="2026-11-21")
    return path


def test_the_report_lies_beside_the_profile_and_its_list_is_printed(
    profile: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*REPORT, profile) == 0
    html = profile.with_name("mine-calibration.html").read_text("utf-8")
    said = capsys.readouterr().out.splitlines()
    assert said[0] == f"report: {profile.with_name('mine-calibration.html')}"
    assert "  - 1 picture of the game's window, its chat blanked, or drawn: The debug screen" in said
    assert "data:image/png" in html
    assert str(Path.home()) not in html
    assert "~/.minecraft/1.20.1.jar" in html.replace("\\", "/")


def test_no_images_and_another_file_can_be_chosen(profile: Path, tmp_path: Path) -> None:
    out = tmp_path / "new" / "folder" / "report.html"
    assert run(*REPORT, profile, "--out", out, "--no-images") == 0
    assert "data:image" not in out.read_text("utf-8").replace("img-src data:", "")
    assert not profile.with_name("mine-calibration.html").exists()


def test_the_same_profile_gives_the_same_report_to_the_byte(profile: Path, tmp_path: Path) -> None:
    for name in ("one", "two"):
        run(*REPORT, profile, "--out", tmp_path / name)
    assert (tmp_path / "one").read_bytes() == (tmp_path / "two").read_bytes()


def test_a_missing_profile_is_a_one_line_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*REPORT, tmp_path / "none.toml") == 2
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_an_out_file_that_is_a_folder_is_a_one_line_error(
    profile: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "folder").mkdir()
    assert run(*REPORT, profile, "--out", tmp_path / "folder") == 2
    assert "name another --out" in capsys.readouterr().err
    assert list(tmp_path.glob("*.unfinished")) == []
