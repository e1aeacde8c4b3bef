"""A profile's files: all of them are found, renamed and deleted together, and no other profile's.

What a list says of a profile, and whether it fits the window that is open.
"""

from pathlib import Path

import platformdirs
import pytest

from calibration.arena.undo import note_path
from calibration.clicks.find import picture_file as clicks_picture
from calibration.profiles import (
    ProfileFacts,
    delete_profile,
    facts_of,
    files_of,
    holds_a_copy,
    named_profile,
    named_profiles,
    rename_profile,
)
from calibration.report.findings import findings_folder
from calibration.report.page import report_path
from mc_nested.errors import ProfileError
from mc_nested.live.menus.click_points import picture_file
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.store import earlier_path, save_profile
from mc_nested.live.profile.tables import CalibratedTable, Profile, ScreenTable


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the profile folder with ``laptop``, which has every possible file, and ``laptop-old``, which has two."""
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    folder = profile_folder()
    for name in ("laptop", "laptop-old"):
        save_profile(Profile(), folder / f"{name}.toml")
    laptop, point = folder / "laptop.toml", picture_file(folder / "laptop.toml", "Respawn")
    point.parent.mkdir()
    findings_folder(laptop).mkdir()
    files = [
        *(earlier_path(laptop), note_path(laptop), clicks_picture(laptop), report_path(laptop), point),
        *(folder / f"laptop{ending}" for ending in ("-font.png", "-walk.png", "-clicks-now.png", ".toml.undone")),
        *(folder / f"laptop.toml.broken{number}" for number in ("", 1)),
        findings_folder(laptop) / "found.json",
        report_path(folder / "laptop-old.toml"),
    ]
    for file in files:
        file.touch()
    return folder


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_files_of_a_profile_are_all_its_calibration_files_and_no_other_profiles(folder: Path) -> None:
    old = {"laptop-old.toml", "laptop-old-calibration.html"}
    assert {path.name for path in files_of(folder / "laptop.toml")} == names(folder) - old
    assert files_of(folder / "laptop.toml")[-1] == folder / "laptop.toml"
    assert {path.name for path in files_of(folder / "laptop-old.toml")} == old


def test_profile_is_found_by_its_name_only(folder: Path) -> None:
    (folder / "folder.toml").mkdir()
    assert [path.stem for path in named_profiles()] == ["laptop", "laptop-old"]
    assert named_profile("laptop") == folder / "laptop.toml"
    for name in ("lapdog", "", "../profiles/laptop", "laptop.toml", str(folder / "laptop.toml")):
        with pytest.raises(ProfileError, match="known are: laptop, laptop-old"):
            named_profile(name)


def test_without_any_profile_the_error_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    assert named_profiles() == []
    with pytest.raises(ProfileError, match="known are: none yet"):
        named_profile("default")


def test_all_files_of_a_renamed_profile_take_the_new_name(folder: Path) -> None:
    before = names(folder)
    rename_profile(folder / "laptop.toml", "pc")
    own = {path.name for path in files_of(folder / "laptop-old.toml")}
    assert names(folder) == own | {name.replace("laptop", "pc", 1) for name in before - own}
    assert (folder / "pc-points" / "Respawn.png").exists()


@pytest.mark.parametrize("name", ["", " ", ".", "..", "a/b", "pc.toml", "/pc"])
def test_a_new_name_that_is_a_path_is_refused(folder: Path, name: str) -> None:
    with pytest.raises(ProfileError, match="is no profile's name"):
        rename_profile(folder / "laptop.toml", name)


def test_new_name_whose_files_exist_already_is_refused(folder: Path) -> None:
    (folder / "pc-calibration").mkdir()
    before = names(folder)
    with pytest.raises(ProfileError, match="pc-calibration: exists already: choose another name"):
        rename_profile(folder / "laptop.toml", "pc")
    assert names(folder) == before


def test_a_rename_that_fails_half_way_changes_nothing(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before, rename = names(folder), Path.rename

    def refuses(path: Path, target: Path) -> Path:
        if path.name == "laptop.toml":
            raise PermissionError(13, "Permission denied", str(path))
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuses)
    with pytest.raises(ProfileError, match="can't be renamed, Permission denied: nothing was changed"):
        rename_profile(folder / "laptop.toml", "pc")
    assert names(folder) == before


def test_a_profile_is_deleted_with_all_its_files_and_no_other_ones(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").touch()
    (folder / "laptop-points" / "link").symlink_to(tmp_path / "mine")
    (folder / "laptop-calibration" / "found.json").unlink()
    (folder / "laptop-calibration").rmdir()
    (folder / "laptop-calibration").symlink_to(tmp_path / "mine")
    delete_profile(folder / "laptop.toml")
    assert names(folder) == {"laptop-old.toml", "laptop-old-calibration.html"}
    assert (tmp_path / "mine" / "letter.txt").exists()


def test_a_file_that_can_not_be_deleted_is_a_one_line_error_and_the_profile_stays(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr("shutil.rmtree", refuses)
    with pytest.raises(ProfileError, match="can't be deleted, Permission denied: the rest is still there"):
        delete_profile(folder / "laptop.toml")
    assert (folder / "laptop.toml").exists()


def test_profile_holds_a_copy_only_if_it_or_its_note_has_one(folder: Path) -> None:
    old = folder / "laptop-old.toml"
    assert holds_a_copy(folder / "laptop.toml"), "there is a note beside it"
    assert not holds_a_copy(old)
    arena = Arena.around((5, 64, -20), "west")
    save_profile(Profile(arena=arena), old)
    assert not holds_a_copy(old)
    save_profile(Profile(arena=arena.model_copy(update={"copied_to": (5, 100, -20)})), old)
    assert holds_a_copy(old)
    old.write_text("broken = [")
    assert not holds_a_copy(old)


ARENA = Arena.around((5, 64, -20), "west", size=20)
CALIBRATED = CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)


def facts(tmp_path: Path, profile: Profile, window: Fingerprint | None = None) -> ProfileFacts:
    save_profile(profile, tmp_path / "laptop.toml")
    return facts_of(tmp_path / "laptop.toml", lambda title: window if title == profile.window.title else None)


def test_profile_facts_give_version_window_scales_and_arena_and_that_the_profile_fits(tmp_path: Path) -> None:
    profile = Profile(arena=ARENA, calibrated=CALIBRATED)
    assert facts(tmp_path, profile, Fingerprint("Minecraft 1.20.1", (854, 480))) == ProfileFacts(
        name="laptop",
        file=tmp_path / "laptop.toml",
        fits=True,
        version="1.20.1",
        window=(854, 480),
        gui_scale=2,
        debug_scale=2,
        arena_size=20,
        date="2026-11-21",
    )


@pytest.mark.parametrize(
    ("window", "fits", "why"),
    [
        (Fingerprint("Minecraft 1.21", (854, 480)), False, "was calibrated on Minecraft 1.20.1, and this is 1.21"),
        (Fingerprint("Minecraft 1.20.1", (1000, 480)), False, "and this one has 1000 x 480"),
        (None, None, "no window of the game is open"),
    ],
)
def test_profile_facts_say_why_the_profile_does_not_fit_or_that_no_window_is_open(
    window: Fingerprint | None, fits: bool | None, why: str, tmp_path: Path
) -> None:
    found = facts(tmp_path, Profile(calibrated=CALIBRATED), window)
    assert found.fits is fits
    assert why in (found.why or "")


def test_profile_facts_leave_open_whether_a_profile_without_a_whole_calibration_fits(tmp_path: Path) -> None:
    found = facts(tmp_path, Profile(arena=ARENA), Fingerprint("Minecraft 1.20.1", (854, 480)))
    assert found.fits is None
    assert found.why == "it was never calibrated as a whole: mc-nested calibrate all --profile laptop"
    assert (found.version, found.window, found.date) == ("1.21", None, None)


def test_missing_font_is_reported_even_without_a_window(tmp_path: Path) -> None:
    jar = tmp_path / "1.20.1.jar"
    profile = Profile(screen=ScreenTable(font=str(jar)), calibrated=CALIBRATED)
    found = facts(tmp_path, profile)
    assert found.fits is False
    assert f"its font {jar} is gone: mc-nested calibrate font --profile laptop" in (found.why or "")
    jar.touch()
    assert facts(tmp_path, profile).fits is None


def test_a_damaged_profile_says_why_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "torn.toml").write_text("[keys]\nforward = 3\n")
    found = facts_of(tmp_path / "torn.toml", lambda _: None)
    assert found.is_damaged
    assert (found.why or "").startswith(f"{tmp_path / 'torn.toml'}: keys.forward: ")
    assert "\n" not in (found.why or "")
