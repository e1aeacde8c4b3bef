"""The files of a sensitivity run: all of them, whole, and the same to the byte for the same rows."""

from pathlib import Path

import cv2
import pytest

from mc_nested.report.sweep import write_sweep
from tests.report.made_sweep import made_sweep


def test_three_files_and_the_same_again(tmp_path: Path) -> None:
    found = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        write_sweep(tmp_path / name, made_sweep())
        found.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert found[0] == found[1]
    assert set(found[0]) == {"sweep.csv", "sweep.md", "sweep.png"}
    picture = cv2.imread(str(tmp_path / "first" / "sweep.png"))
    assert picture is not None
    # A point left of the base in one panel at least, in the colour of final scores (BGR).
    assert (abs(picture.astype(int) - (0xB2, 0x72, 0x00)).max(axis=2) < 8).any()


def test_a_full_disk_leaves_the_old_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_sweep(tmp_path, made_sweep())
    before = (tmp_path / "sweep.png").read_bytes()

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", full)
    with pytest.raises(OSError, match="No space left"):
        write_sweep(tmp_path, made_sweep())
    assert (tmp_path / "sweep.png").read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"sweep.csv", "sweep.md", "sweep.png"}
