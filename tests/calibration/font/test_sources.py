"""The order in which fonts are tried: active packs, the topmost first, then the version's own jar, then others.

The font of a recording that comes from another computer.
"""

import zipfile
from pathlib import Path

import pytest

from calibration.font.sources import font_of_recording, font_sources
from calibration.installation.folders import System
from mc_nested.errors import FontError, RecordingError
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.recording_file import PartWriter
from mc_nested.live.vision.font import ENTRY
from tests.calibration.contexts import font_file_in


@pytest.fixture
def game(tmp_path: Path) -> Path:
    """Return the game folder of a Linux user with two versions and two packs."""
    folder = tmp_path / ".minecraft"
    for version in ("1.12.2", "1.20.1"):
        (folder / "versions" / version).mkdir(parents=True)
        (folder / "versions" / version / f"{version}.jar").write_bytes(b"jar")
    (folder / "resourcepacks" / "faithful").mkdir(parents=True)
    (folder / "resourcepacks" / "plain.zip").write_bytes(b"zip")
    (folder / "options.txt").write_text("version:3465\nlang:en_us\n", "utf-8")
    return folder


def options(game: Path, packs: str) -> None:
    (game / "options.txt").write_text(f"lang:de_de\nresourcePacks:{packs}\nforceUnicodeFont:true\n", "utf-8")


def tried(game: Path, version: str | None = "1.20.1") -> list[str]:
    return [path.name for path in font_sources(System("linux", game.parent, {}), version).paths]


def test_without_packs_the_versions_own_jar_comes_first_then_the_others(game: Path) -> None:
    assert tried(game) == ["1.20.1.jar", "1.12.2.jar"]
    assert tried(game, "1.12.2") == ["1.12.2.jar", "1.20.1.jar"]


def test_packs_come_first_and_the_topmost_before_the_others(game: Path) -> None:
    options(game, '["vanilla","file/plain.zip","file/faithful"]')
    assert tried(game)[:2] == ["faithful", "plain.zip"]


def test_pack_named_without_a_file_prefix_as_in_1_12_is_found(game: Path) -> None:
    options(game, '["plain.zip"]')
    assert tried(game)[0] == "plain.zip"


@pytest.mark.parametrize("packs", ["", "nonsense", '{"a": 1}', "[1, null]", '["file/gone.zip"]', '["file/../../x"]'])
def test_packs_that_are_not_there_or_can_not_be_read_are_left_out(game: Path, packs: str) -> None:
    options(game, packs)
    assert tried(game) == ["1.20.1.jar", "1.12.2.jar"]


def test_font_sources_include_the_language_and_force_unicode_options(game: Path) -> None:
    options(game, "[]")
    known = font_sources(System("linux", game.parent, {}), None).options
    assert (known["lang"], known["forceUnicodeFont"]) == ("de_de", "true")


def test_computer_without_the_game_has_no_font_sources(tmp_path: Path) -> None:
    assert font_sources(System("linux", tmp_path, {}), "1.20.1") == font_sources(System("linux", tmp_path, {}), None)
    assert font_sources(System("linux", tmp_path, {}), None).paths == ()


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
def test_recording_from_another_computer_uses_this_computers_jar_of_that_version(font: str, tmp_path: Path) -> None:
    file, here = recording_of(f'[screen]\nfont = "{font}"\n', tmp_path), System("linux", tmp_path, {})
    with pytest.raises(FontError, match="isn't on this computer: name its client jar with --font"):
        font_of_recording(file, here)
    jar_in(tmp_path, "1.21.4")
    same = jar_in(tmp_path, "1.20.1")
    assert font_of_recording(file, here) == same


def test_the_font_that_a_recording_names_comes_first(tmp_path: Path) -> None:
    own = font_file_in(tmp_path)
    jar_in(tmp_path, "1.20.1")
    file = recording_of(f"[screen]\nfont = '{own}'\n", tmp_path)
    assert font_of_recording(file, System("linux", tmp_path, {})) == own


def test_a_recording_without_a_profile_is_a_one_line_error(tmp_path: Path) -> None:
    writer = PartWriter(tmp_path / "one.mcap", {"format": str(FORMAT)})
    writer.close()
    with pytest.raises(RecordingError, match="says nothing of its profile"):
        font_of_recording(tmp_path / "one.mcap", System("linux", tmp_path, {}))
