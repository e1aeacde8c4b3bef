import importlib.metadata
import json
import zipfile
from pathlib import Path

import cv2
import pytest

from calibration.bug_report import write_bug_report
from calibration.doctor.check import Check, CheckName
from calibration.report.privacy import Names
from mc_nested.cli import recordings
from mc_nested.cli.output import json_fields
from mc_nested.live.recording.recording_file import facts_of
from mc_nested.live.recording.run_recorder import MOST_RECORDINGS, kept_recordings, recordings_folder
from sim.client.drawing.letters import drawn_atlas
from tests.calibration.contexts import font_file_in
from tests.cli import running
from tests.live.recording.recorded_play import record_play

pytestmark = pytest.mark.skipif("sys.platform != 'linux'", reason="elsewhere the folder isn't named by a variable")


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recorded") / "play"
    record_play(folder, 30, seed=5)
    return folder


@pytest.fixture
def kept(recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return one recording among those that are kept, named "play"."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    recordings_folder().mkdir(parents=True)
    (recordings_folder() / "play").symlink_to(recorded)
    return recordings_folder() / "play"


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    code, said = running.run(*words), capsys.readouterr()
    return code, said.out + said.err


def test_recordings_are_listed_with_their_actions_and_damage(kept: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (kept.parent / "broken").mkdir()
    (kept.parent / "broken" / "00001.mcap").write_bytes(b"nothing")
    code, said = run(capsys, "recordings")
    assert code == 0
    assert [word for word in ("play", "whole", "30", "is no recording") if word not in said] == []
    assert "2 recordings in" in said


def test_a_recording_is_verified_by_its_name(kept: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, said = run(capsys, "recordings", "verify", kept.name)
    assert code == 0
    assert "30 actions" in said
    assert said.strip().endswith("whole")


def test_recordings_are_listed_as_json(kept: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (kept.parent / "broken").mkdir()
    (kept.parent / "broken" / "00001.mcap").write_bytes(b"nothing")
    code, said = run(capsys, "recordings", "list", "--json")
    found = json.loads(said)
    assert (code, found.keys()) == (0, json_fields(recordings.list_recordings).keys())
    assert {frozenset(each) for each in found["recordings"]} == {frozenset(json_fields(recordings.verify))}
    by_name = {Path(each["recording"]).name: each for each in found["recordings"]}
    assert (by_name["play"]["actions"], by_name["play"]["damage"]) == (30, [])
    assert (by_name["broken"]["actions"], len(by_name["broken"]["damage"])) == (None, 1)
    assert json.loads(run(capsys, "recordings", "verify", "play", "--json")[1]) == by_name["play"]
    assert run(capsys, "recordings", "--json", "verify", "play") == (
        2,
        "mc-nested: write --json at the end: mc-nested recordings verify --json\n",
    )


def test_verify_exits_with_1_for_a_recording_with_lost_parts(
    kept: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole = next(kept.glob("*.mcap")).read_bytes()
    (tmp_path / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    code, said = run(capsys, "recordings", "verify", str(tmp_path / "cut.mcap"))
    assert code == 1
    assert "whole" not in said


def test_unknown_recording_name_is_refused_in_one_line(kept: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "replay", "nope") == (
        2,
        f"mc-nested: no recording 'nope': the last ones kept are: {kept.name}\n",
    )


def test_part_cut_from_a_recording_replays_without_differences(
    kept: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "part.mcap"
    code, said = run(capsys, "recordings", "cut", kept.name, str(out), "--no-pictures")
    assert (code, "0 pictures" in said) == (0, False)
    code, said = run(capsys, "replay", str(out), "--font", str(font_file_in(tmp_path)), "--json")
    seen = json.loads(said)
    assert code == 0
    assert (seen["actions"], seen["followed"], seen["differences"]) == (30, 30, [])
    code, said = run(capsys, "recordings", "cut", kept.name, str(out))
    assert (code, "is there already" in said) == (2, True)


def test_replay_reports_and_pictures_a_reading_that_differs(
    kept: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    atlas = drawn_atlas().copy()
    atlas[24:32, 16:24] = atlas[24:32, 16:24][::-1]  # the glyph of 2
    cv2.imwrite(str(tmp_path / "other.png"), atlas)
    pictures = tmp_path / "pictures"
    words = ("replay", kept.name, "--font", str(tmp_path / "other.png"), "--pictures", str(pictures))
    code, said = run(capsys, *words)
    assert code == 1
    assert "reading" in said
    assert "30 of 30 actions followed" in said
    picture = cv2.imread(str(min(pictures.iterdir())))
    assert picture is not None
    assert picture.shape == (480, 854, 3)


def test_recording_into_a_folder_that_is_not_empty_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    code, said = run(capsys, "calibrate", "walk", "--record", str(tmp_path / "full"))
    assert (code, "holds something already" in said) == (2, True)


def test_recordings_are_deleted_if_there_are_too_many(kept: Path) -> None:
    from mc_nested.live.recording import run_recorder

    for number in range(MOST_RECORDINGS + 2):
        (kept.parent / f"old-{number:02d}").mkdir()
        (kept.parent / f"old-{number:02d}" / "00001.mcap").write_bytes(b"")
    run_recorder.make_room()
    assert len(kept_recordings()) == MOST_RECORDINGS - 1


def test_a_bug_report_without_a_recording_holds_the_versions(tmp_path: Path) -> None:
    out = tmp_path / "report.zip"
    said = write_bug_report(out, [], None, {}, 600.0, Names("/home/ann", ("ann",)))
    assert said == [
        "doctor.json: the 0 rows of mc-nested doctor",
        "versions.json: of mc-nested, Python and the system",
    ]
    with zipfile.ZipFile(out) as file:
        assert json.loads(file.read("versions.json")).keys() == {"version", "python", "system"}


def test_bug_report_contains_exactly_the_listed_files_and_no_user_names(recorded: Path, tmp_path: Path) -> None:
    check = Check(CheckName.CLIPBOARD, "pass", "/home/ann/.minecraft is read", "")
    out = tmp_path / "report.zip"
    profile = '[screen]\nfont = "/home/ann/versions/1.20.1.jar"\n'
    said = write_bug_report(out, [check], profile, {"recording.mcap": recorded}, 600.0, Names("/home/ann", ("ann",)))
    with zipfile.ZipFile(out) as file:
        about = [line.split(":")[0] for line in said]
        assert about[-1] == "what may be seen on its pictures"
        assert set(file.namelist()) == set(about[:-1])
        versions = json.loads(file.read("versions.json"))
        texts = [file.read(name) for name in file.namelist()]
        file.extract("recording.mcap", tmp_path)
    assert not any(b"/home/ann" in text for text in texts)
    assert b"~/.minecraft is read" in texts[0]
    assert said[3].endswith(": 30 actions")
    assert versions["version"] == versions["recording"]["version"] == importlib.metadata.version("mc-nested")
    assert said[2] == (
        "versions.json: of mc-nested, Python and the system; of the recording: what, version, python, system, size, "
        "window, monitors, title"
    )
    assert facts_of(tmp_path / "recording.mcap")["what"] == "test"
