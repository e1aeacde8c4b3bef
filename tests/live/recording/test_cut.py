"""Cutting a recording that others will read removes names and paths, and leaves all else as it is."""

from pathlib import Path
from typing import Any

import pytest
import tomlkit

from calibration.report.privacy import Names
from mc_nested.errors import RecordingError
from mc_nested.live.profile.tables import Profile, ScreenTable, WorldTable
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.recording_file import PartWriter, TimedCall, facts_of, read_recording
from mc_nested.live.recording.replayed_run import profile_of

CLEAN = Names("/home/ann", ("ann", "left", "note")).removed_from


def cleaned(folder: Path, *calls: list[Any]) -> list[list[Any]]:
    writer = PartWriter(folder / "whole.mcap", {"format": str(FORMAT)})
    writer.write([TimedCall(at, call) for at, call in enumerate(calls)])
    writer.close()
    cut(folder / "whole.mcap", folder / "part.mcap", clean=CLEAN)
    return [each.call for each in read_recording(folder / "part.mcap") if isinstance(each, TimedCall)]


@pytest.mark.parametrize(
    ("call", "without_names"),
    [
        (["title", "Minecraft - ann"], ["title", "Minecraft - <user>"]),
        (["error", "display", "DesktopError", "/home/ann/x"], ["error", "display", "DesktopError", "~/x"]),
        (["elsewhere", "error", "display", "DesktopError", "/home/ann/x"], [..., "error", ..., ..., "~/x"]),
        (["stop", "/home/ann/x is gone"], ["stop", "~/x is gone"]),
        (["note", "fails", {"problem": "/home/ann/x"}], ["note", "fails", {"problem": "~/x"}]),
        (["note", "reads", {"problem": "saved by ann"}], ["note", "reads", {"problem": "saved by <user>"}]),
    ],
    ids=lambda call: str(call[:2]),
)
def test_cutting_removes_names_and_paths_from_errors_and_notes(
    call: list[Any], without_names: list[Any], tmp_path: Path
) -> None:
    (found,) = cleaned(tmp_path, call)
    expected = [word if wanted is ... else wanted for word, wanted in zip(call, without_names, strict=True)]
    assert found == expected


def test_cutting_keeps_only_the_last_part_of_a_profiles_paths(tmp_path: Path) -> None:
    profile = Profile(
        screen=ScreenTable(font="/mnt/games of ann b/1.20.1/1.20.1.jar", debug_scale=2),
        world=WorldTable(folder=r"D:\Diary\saves\Arena", template="~/copies/of mine/Arena", name="Arena"),
    )
    document = tomlkit.dumps(profile.model_dump(mode="json", exclude_none=True, exclude_defaults=True))
    writer = PartWriter(tmp_path / "whole.mcap", {"format": str(FORMAT), "profile": document})
    writer.write([TimedCall(1, ["now", 1.0])])
    writer.close()
    cut(tmp_path / "whole.mcap", tmp_path / "part.mcap", clean=CLEAN)
    seen = profile_of(tmp_path / "part.mcap", facts_of(tmp_path / "part.mcap"))
    assert seen.screen == ScreenTable(font="~/1.20.1.jar", debug_scale=2)
    assert seen.world == WorldTable(folder="~/Arena", template="~/Arena", name="Arena")
    assert seen.model_copy(update={"screen": profile.screen, "world": profile.world}) == profile
    trim(tmp_path / "whole.mcap", 1.0)
    assert facts_of(tmp_path / "whole.mcap")["profile"] == document


def test_cutting_a_recording_with_a_broken_profile_is_refused_and_writes_no_file(tmp_path: Path) -> None:
    writer = PartWriter(tmp_path / "whole.mcap", {"format": str(FORMAT), "profile": "[screen\n"})
    writer.write([TimedCall(1, ["now", 1.0])])
    writer.close()
    with pytest.raises(RecordingError, match=r"whole\.mcap: its profile"):
        cut(tmp_path / "whole.mcap", tmp_path / "part.mcap", clean=CLEAN)
    assert not (tmp_path / "part.mcap").exists()


@pytest.mark.parametrize(
    "call",
    [
        ["key", "press", "left.shift"],
        ["elsewhere", "key", "release", "left.shift"],
        ["mouse", "press", "left"],
        ["note", "done", {"cell": [1, 2], "seconds": 0.5}],
        ["note", "plans", {"key": "left", "ticks": 3, "sneak": False}],
        ["note", "reads", {"xyz": [0.5, 64.0, 0.5], "target": [[1, 2, 3], "note:left"]}],
        ["note", "types", {"line": "/fill 1 2 3 4 5 6 note:left"}],
        ["note", "reads", {"problem": None}],
        ["key", "type", "/fill 1 2 3 4 5 6 note:left"],
        ["screen", "is_typed", ["/fill 1 2 3 4 5 6 note:left"], True, None],
        ["screen", "read", [], {"xyz": [0.5, 64.0, 0.5]}, {"text": "QUJD/ann/"}],
    ],
    ids=lambda call: str(call[:2]),
)
def test_cutting_leaves_keys_commands_pixels_and_readings_unchanged(call: list[Any], tmp_path: Path) -> None:
    assert cleaned(tmp_path, call) == [call]
