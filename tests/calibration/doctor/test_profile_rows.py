"""The profile's checks, and the font that the doctor reads with."""

from pathlib import Path

import pytest

from calibration.doctor.profile_rows import fit_row, font_row, profile_row
from calibration.installation.folders import System
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable
from mc_nested.live.vision.layout import Scales
from tests.calibration.contexts import font_file_in

CALIBRATED = Profile(calibrated=CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2))


def test_profile_row_tells_a_missing_a_good_and_a_broken_profile_apart(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    profile, row = profile_row(str(file))
    assert (profile, row.status) == (None, "skip")
    assert row.fix == f"mc-nested calibrate all --profile {file} makes it"
    save_profile(Profile(), file)
    assert profile_row(str(file))[0] == Profile()
    assert profile_row(str(file))[1].status == "pass"
    file.write_text("walking = 1\n", "utf-8")
    profile, row = profile_row(str(file))
    assert (profile, row.status, row.fix) == (None, "fail", "mend it, or move it away")


def test_fix_for_a_broken_profile_offers_calibrate_undo_if_there_is_an_earlier_one(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    save_profile(Profile(), file)
    save_profile(CALIBRATED, file)
    file.write_text("walking = 1\n", "utf-8")
    assert profile_row(str(file))[1].fix == f"mend it, or mc-nested calibrate undo --profile {file}"


@pytest.mark.parametrize(
    ("profile", "seen", "status"),
    [
        (None, Fingerprint("Minecraft 1.20.1", (854, 480), Scales(2, 2)), "skip"),
        (Profile(), Fingerprint("Minecraft 1.20.1", (854, 480), Scales(2, 2)), "skip"),
        (CALIBRATED, None, "skip"),
        (CALIBRATED, Fingerprint("Minecraft 1.20.1", (854, 480), Scales(2, 2)), "pass"),
        (CALIBRATED, Fingerprint("Minecraft 1.20.1", (855, 480), Scales(2, 2)), "fail"),
    ],
)
def test_a_profile_fits_the_window_that_it_was_calibrated_on(
    profile: Profile | None, seen: Fingerprint | None, status: str
) -> None:
    row = fit_row("mine", profile, seen)
    assert row.status == status
    assert (row.fix != "") == (status == "fail" or profile == Profile())


def test_font_row_reads_the_profiles_font_and_has_a_fix_if_there_is_none(tmp_path: Path) -> None:
    system = System("linux", tmp_path / "home", {})
    own = Profile(screen=ScreenTable(font=str(font_file_in(tmp_path))))
    font, row = font_row(own, system, "1.20.1")
    assert font is not None
    assert row.status == "pass"
    for profile in (None, Profile()):
        font, row = font_row(profile, system, None)
        assert (font, row.status) == (None, "fail")
        assert row.fix == "name your game's client jar: mc-nested calibrate font --font JAR"
    gone = Profile(screen=ScreenTable(font=str(tmp_path / "gone.png")))
    font, row = font_row(gone, system, None)
    assert (font, row.status) == (None, "fail")
    assert "gone.png" in row.detail


def test_font_row_reads_another_versions_jar_if_the_first_is_unreadable_or_missing(tmp_path: Path) -> None:
    system = System("linux", tmp_path, {})
    jars = [tmp_path / ".minecraft" / "versions" / version / f"{version}.jar" for version in ("1.20.1", "1.19.4")]
    for jar in jars:
        jar.parent.mkdir(parents=True)
    jars[0].write_text("no jar", "utf-8")
    jars[1].write_bytes(font_file_in(tmp_path).read_bytes())
    font, row = font_row(None, system, "1.20.1")
    assert font is not None
    assert row.status == "fail"
    assert "1.20.1.jar" in row.detail
    assert row.detail.endswith(f"; read with that of {jars[1]}")
    jars[0].unlink()
    font, row = font_row(None, system, "1.20.1")
    assert font is not None
    assert (row.status, row.detail) == ("pass", f"found, of Minecraft 1.19.4: {jars[1]}")


def test_profile_of_an_unknown_format_fails_with_the_fix_to_update_the_program(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('[calibrated]\ndate = "2026-11-21"\nformat = 99\n', "utf-8")
    row = profile_row(str(file))[1]
    assert row.status == "fail"
    assert "a profile of format 99, by another version of mc-nested" in row.detail
    assert row.fix.startswith("update mc-nested, or make a new one")


def test_a_font_that_is_named_is_taken_before_the_profiles_own(tmp_path: Path) -> None:
    named = font_file_in(tmp_path)
    own = Profile(screen=ScreenTable(font=str(tmp_path / "gone.png")))
    font, row = font_row(own, System("linux", tmp_path, {}), "1.20.1", named)
    assert font is not None
    assert (row.status, row.detail) == ("pass", f"as named: {named}")
    font, row = font_row(own, System("linux", tmp_path, {}), "1.20.1", tmp_path / "none.png")
    assert (font, row.status) == (None, "fail")
    assert "none.png" in row.detail
