"""The files of an ablation."""

import csv
from pathlib import Path

from matplotlib.image import imread

from mc_nested.report.ablation import write_ablation
from mc_nested.report.ablation_results import AblationRow
from tests.report.made_ablation import made_ablation

NAMES = ("ablation.csv", "ablation.md", "ablation.png")


def test_the_same_rows_give_the_same_files(tmp_path: Path) -> None:
    for folder in (tmp_path / "one", tmp_path / "two"):
        folder.mkdir()
        write_ablation(folder, made_ablation())
    for name in NAMES:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_the_rows_hold_every_trial_and_leave_never_empty(tmp_path: Path) -> None:
    write_ablation(tmp_path, made_ablation())
    with (tmp_path / "ablation.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == AblationRow._fields
    assert len(rows) == 24
    assert [row["played_to_optimum"] for row in rows if (row["part"], row["scenario"]) == ("no | hope", "line")] == [
        "",
        "",
        "20",
        "",
    ]


def test_the_picture_has_the_colours_of_trials_of_medians_and_of_never(tmp_path: Path) -> None:
    write_ablation(tmp_path, made_ablation())
    picture = (imread(tmp_path / "ablation.png")[..., :3] * 255).round().astype(int).reshape(-1, 3)
    for colour in ("56B4E9", "0072B2", "D55E00"):
        wanted = [int(colour[at : at + 2], 16) for at in (0, 2, 4)]
        assert (picture == wanted).all(axis=1).sum() > 50, colour
