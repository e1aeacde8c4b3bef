"""The font of a recording that comes from another computer."""

import zipfile
from pathlib import Path

import pytest

from calibration.font.of_recording import font_of_recording
from calibration.installation.folders import System
from mc_nested.errors import FontError, RecordingError
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.part_writer import PartWriter
from mc_nested.live.vision.font import ENTRY
from tests.calibration.contexts import font_file_in

ELSEWHERE = [
    r"C:\\Users\\<user>\\AppData\\Roaming\\.minecraft\\versions\\1.20.1\\1.20.1.jar",
    r"~\\AppData\\Roaming\\.minecraft\\versions\\1.20.1\\1.20.1.jar",
    "D:/Games/1.20.1.jar",
    "/home/nobody/.minecraft/versions/1.20.1/1.20.1.jar",
    "~nobody-of-this-name/1.20.1.jar",
]
"""Fonts of other people's profiles, as a cut recording names them."""


def recording_of(profile: str, folder: Path) -> Path:
    file = folder / "one.mcap"
    writer = PartWriter(file, {"format": str(FORMAT), "title": "Minecraft 1.20.1 - Singleplayer", "profile": profile})
    writer.close()
    return file


def jar_in(folder: Path, version: str) -> Path:
    jar = folder / ".minecraft" / "versions" / version / f"{version}.jar"
    jar.parent.mkdir(parents=True)
    with zipfile.ZipFile(jar, "w") as packed:
        packed.write(font_file_in(folder), ENTRY)
    return jar


@pytest.mark.parametrize("font", ELSEWHERE)
def test_a_font_of_another_computer_is_this_ones_of_that_version(font: str, tmp_path: Path) -> None:
    file, here = recording_of(f'[screen]\nfont = "{font}"\n', tmp_path), System("linux", tmp_path, {})
    with pytest.raises(FontError, match="isn't on this computer: name its client jar with --font"):
        font_of_recording(file, here)
    jar_in(tmp_path, "1.21.4")
    same = jar_in(tmp_path, "1.20.1")
    assert font_of_recording(file, here) == same


def test_its_own_font_comes_first(tmp_path: Path) -> None:
    own = font_file_in(tmp_path)
    jar_in(tmp_path, "1.20.1")
    file = recording_of(f"[screen]\nfont = '{own}'\n", tmp_path)
    assert font_of_recording(file, System("linux", tmp_path, {})) == own


def test_one_without_a_profile_is_one_line(tmp_path: Path) -> None:
    writer = PartWriter(tmp_path / "one.mcap", {"format": str(FORMAT)})
    writer.close()
    with pytest.raises(RecordingError, match="says nothing of its profile"):
        font_of_recording(tmp_path / "one.mcap", System("linux", tmp_path, {}))
