"""Every recording in this folder is read and decided as it was: one that is dropped in becomes a test.

``NAME.mcap`` is read with the font ``NAME.png`` beside it, else with its profile's, else with that of a game on this
computer. Recordings of the virtual client and of the rehearsal window are in ``virtual/``: they are written in the
project's own font. Cut a part out of a longer one with
``mc-nested recordings cut REC tests/recordings/NAME.mcap --no-pictures``.

There is none of a real game or of the stand-in here, since their letters are Mojang's.
"""

import zipfile
from pathlib import Path

import pytest

from calibration.font.sources import font_of_recording
from calibration.installation.folders import System
from mc_nested.errors import FontError
from mc_nested.live.recording.replayed_run import replay
from mc_nested.live.vision.font import ENTRY, Font, load_font
from tests.calibration.contexts import font_file_in
from tests.sim.client.playing import FONT

FOLDER = Path(__file__).parent
VIRTUAL = FOLDER / "virtual"
RECORDINGS = sorted(FOLDER.rglob("*.mcap"))


def check(path: Path, system: System) -> None:
    seen = replay(path, font_for(path, system))
    assert seen.differences == []
    assert seen.damaged == []
    assert seen.read_anew > 0
    assert seen.followed == seen.actions


def font_for(path: Path, system: System) -> Font:
    if path.parent == VIRTUAL:
        return FONT
    beside = path.with_suffix(".png")
    return load_font(beside if beside.is_file() else font_of_recording(path, system))


def test_folder_has_recordings() -> None:
    assert RECORDINGS


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.stem)
def test_recording_is_read_and_decided_as_it_was(path: Path) -> None:
    check(path, System.here())


def test_recording_that_is_dropped_in_finds_its_font(tmp_path: Path) -> None:
    system = System("linux", tmp_path, {})
    dropped = tmp_path / "line.mcap"
    dropped.write_bytes((VIRTUAL / "virtual-client-1.20.1.mcap").read_bytes())
    with pytest.raises(FontError, match="isn't on this computer: name its client jar with --font"):
        check(dropped, system)
    jar = tmp_path / ".minecraft" / "versions" / "1.20.1" / "1.20.1.jar"
    jar.parent.mkdir(parents=True)
    with zipfile.ZipFile(jar, "w") as packed:
        packed.write(font_file_in(tmp_path), ENTRY)
    check(dropped, system)
    jar.unlink()
    font_file_in(tmp_path).rename(dropped.with_suffix(".png"))
    check(dropped, system)
