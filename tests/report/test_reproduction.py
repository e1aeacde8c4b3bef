"""The files of an experiment: all of them, and the same to the byte for the same results."""

from pathlib import Path

from mc_nested.report.claims.judge import judge
from mc_nested.report.reproduction import write_reproduction
from mc_nested.report.results import read_evaluations
from tests.report.made_results import made, the_papers


def files_of(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_four_files_and_the_verdicts(tmp_path: Path) -> None:
    results = made(the_papers("zigzag"))
    assert write_reproduction(tmp_path, results) == judge(results)
    assert set(files_of(tmp_path)) == {"results.csv", "figure5.png", "figure5.svg", "report.md"}
    assert read_evaluations(tmp_path / "results.csv") == results.evaluations
    assert "](figure5.png)" in (tmp_path / "report.md").read_text("utf-8")
    assert b"\r" not in (tmp_path / "report.md").read_bytes()


def test_the_long_run_is_kept_beside_the_short(tmp_path: Path) -> None:
    longer = made(the_papers("zigzag"), episodes=900)
    write_reproduction(tmp_path, made(the_papers("zigzag")), longer)
    assert read_evaluations(tmp_path / "results_longer.csv") == longer.evaluations


def test_the_same_results_give_the_same_files(tmp_path: Path) -> None:
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        write_reproduction(tmp_path / name, made(the_papers("zigzag")), made(the_papers("zigzag"), episodes=900))
    assert files_of(tmp_path / "first") == files_of(tmp_path / "second")
