"""``mc-nested profiles`` lists, shows, renames and deletes profiles."""

import json
from pathlib import Path

import platformdirs
import pytest
import typer

from mc_nested.cli import profiles
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.fingerprint import Fingerprint
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import CalibratedTable, Profile
from tests.cli.running import run

ARENA = Arena.around((5, 64, -20), "west").model_copy(update={"copied_to": (5, 100, -20)})
CALIBRATED = CalibratedTable(date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the profile folder, with three profiles; a game's window is open that one of them doesn't fit."""
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    monkeypatch.setattr(profiles, "window_of", lambda _: Fingerprint("Minecraft 1.20.1 - Singleplayer", (854, 480)))
    save_profile(Profile(arena=ARENA, calibrated=CALIBRATED), profile_folder() / "laptop.toml")
    wide = CALIBRATED.model_copy(update={"window": (1920, 1080)})
    save_profile(Profile(calibrated=wide), profile_folder() / "pc.toml")
    (profile_folder() / "torn.toml").write_text("[keys")
    return profile_folder()


def test_profiles_are_listed_with_what_they_were_calibrated_on(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("profiles") == 0
    lines = capsys.readouterr().out.splitlines()
    cells = [[cell.strip() for cell in line.split("  ") if cell.strip()] for line in lines[:4]]
    assert cells[0] == ["profile", "version", "window", "GUI scale", "arena", "calibrated", "fits"]
    assert cells[1] == ["laptop", "1.20.1", "854 x 480", "2", "15 x 15", "2026-11-21", "yes"]
    assert cells[2] == ["pc", "1.20.1", "1920 x 1080", "2", "2026-11-21", "no"]
    assert cells[3] == ["torn", "damaged"]
    assert lines[4].startswith("pc: profile pc was calibrated in a window of 1920 x 1080 pixels")
    assert lines[5].startswith("torn: ")
    assert len(lines) == 6


@pytest.mark.parametrize("words", [["profiles"], ["profiles", "list"]])
def test_json_lists_one_object_for_each_profile(
    words: list[str], folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*words, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["folder"] == str(folder)
    assert [(each["name"], each["fits"], each["is_damaged"]) for each in found["profiles"]] == [
        ("laptop", True, False),
        ("pc", False, False),
        ("torn", None, True),
    ]
    assert found["profiles"][0]["window"] == [854, 480]


def test_without_any_profile_the_list_says_how_to_make_one(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for file in folder.iterdir():
        file.unlink()
    assert run("profiles") == 0
    assert capsys.readouterr().out == f"no profiles in {folder}: mc-nested calibrate all makes one\n"


def test_a_profile_is_shown_with_its_files(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("profiles", "show", "pc") == 0
    shown = capsys.readouterr().out
    assert str(folder / "pc.toml") in shown
    assert "make it that size again" in " ".join(shown.split())
    assert run("profiles", "show", "torn", "--json") == 0
    assert json.loads(capsys.readouterr().out)["files"] == [str(folder / "torn.toml")]


def test_renaming_a_profile_says_what_to_do_with_its_runs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("profiles", "rename", "pc", "desk") == 0
    assert capsys.readouterr().out.splitlines() == [
        f"renamed to {folder / 'desk.toml'}",
        "a run that was trained with pc goes on with --resume RUN --profile desk",
    ]


@pytest.mark.parametrize("answer", [True, False])
def test_a_profile_is_deleted_after_a_question(answer: bool, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []

    def confirm(question: str) -> bool:
        asked.append(question)
        return answer

    monkeypatch.setattr(typer, "confirm", confirm)
    assert run("profiles", "delete", "pc") == 0
    assert asked == ["Delete pc (pc.toml)?"]
    assert (folder / "pc.toml").exists() is not answer


def test_deleting_a_profile_says_that_its_arena_can_not_be_put_back_afterwards(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run("profiles", "delete", "laptop", "torn", "--yes") == 0
    said = capsys.readouterr().out.splitlines()
    assert "mc-nested calibrate arena --undo --profile laptop puts that back, and can't afterwards" in said[0]
    assert said[1:] == ["deleted laptop", "deleted torn"]


def test_unknown_profile_name_is_refused_in_one_line_and_nothing_is_deleted(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("profiles", "delete", "pc", "nothing", "--yes") == 2
    said = capsys.readouterr().err
    assert said == "mc-nested: no profile is named 'nothing': known are: laptop, pc, torn\n"
    assert (folder / "pc.toml").exists()


def test_window_of_finds_no_window_without_a_desktop(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    assert profiles.window_of("^no window has such a title$") is None
