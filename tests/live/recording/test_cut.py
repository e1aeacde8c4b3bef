"""What is taken out of a recording that others will read, and what has to stay as it is."""

from pathlib import Path
from typing import Any

import pytest

from calibration.report.privacy import Names
from mc_nested.live.recording.cut import cut
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.part_writer import PartWriter
from mc_nested.live.recording.recording_file import TimedCall, read_recording

CLEAN = Names("/home/ann", ("ann", "left", "note")).removed_from


def cleaned(folder: Path, *calls: list[Any]) -> list[list[Any]]:
    writer = PartWriter(folder / "whole.mcap", {"format": str(FORMAT)})
    writer.write(list(enumerate(calls)), [], [])
    writer.close()
    cut(folder / "whole.mcap", folder / "part.mcap", 0, len(calls), CLEAN)
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
def test_names_and_paths_are_taken_out_of_what_is_said(
    call: list[Any], without_names: list[Any], tmp_path: Path
) -> None:
    (found,) = cleaned(tmp_path, call)
    expected = [word if wanted is ... else wanted for word, wanted in zip(call, without_names, strict=True)]
    assert found == expected


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
def test_keys_pixels_and_readings_stay_as_they_are(call: list[Any], tmp_path: Path) -> None:
    assert cleaned(tmp_path, call) == [call]
