"""The files of a benchmark: all of them, whole, and the same to the byte for the same rows."""

from pathlib import Path

import cv2
import pytest

from mc_nested.report.benchmark import write_benchmark
from mc_nested.report.benchmark_results import Benchmark
from tests.report.made_benchmark import made_benchmark, row


def test_three_files_and_the_same_again(tmp_path: Path) -> None:
    found = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        overall = write_benchmark(tmp_path / name, made_benchmark())
        found.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert found[0] == found[1]
    assert set(found[0]) == {"benchmark.csv", "benchmark.md", "benchmark.png"}
    assert (overall[0][0], overall[0][1].solved) == ("nested, quick", 24)
    picture = cv2.imread(str(tmp_path / "first" / "benchmark.png"))
    assert picture is not None
    # Both contestants are drawn on either side, in their colours (BGR).
    for colour in ((0xB2, 0x72, 0x00), (0x00, 0x5E, 0xD5)):
        columns = (abs(picture.astype(int) - colour).max(axis=2) < 8).any(axis=0).nonzero()[0]
        assert columns.min() < picture.shape[1] / 2 < columns.max()


def test_nothing_solved_and_one_kind_alone_can_be_drawn(tmp_path: Path) -> None:
    write_benchmark(tmp_path, Benchmark("mine.toml", 1, 0, {"nested, x": 5}, [row("x", 0, None)], {"nested, x": [1.0]}))
    text = (tmp_path / "benchmark.md").read_text("utf-8")
    assert "one design of 10 blocks of `mine.toml`. One trial on each, seed 0." in text
    assert "##" not in text


def test_a_full_disk_leaves_the_old_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_benchmark(tmp_path, made_benchmark())
    before = (tmp_path / "benchmark.png").read_bytes()

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", full)
    with pytest.raises(OSError, match="No space left"):
        write_benchmark(tmp_path, made_benchmark())
    assert (tmp_path / "benchmark.png").read_bytes() == before
