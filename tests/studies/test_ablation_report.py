"""The report of an ablation: measures, table, figure."""

import math
from dataclasses import replace
from pathlib import Path

from matplotlib.image import imread

from mc_nested.studies.ablation import COLUMNS, STUDY, measures_of, report
from mc_nested.studies.study import write_report
from mc_nested.studies.trial import on_each
from tests.cli.running import table
from tests.studies.made_trials import LINE, PAPER, ZIGZAG, made_arm, made_config, made_trial

PLAYED: dict[str, list[int | None]] = {
    "whole": [5, 7, 6, 9],
    "no | hope": [None, None, 20, None],
    "old": [30, 30, 100, 200],
}
"""Real episodes until each trial was solved."""

OF = {
    "whole": ("model-based", "", 200),
    "no | hope": ("model-based", "nothing is imagined to pay", 200),
    "old": ("tuned", "", 3000),
}

ARMS = {
    name: replace(
        made_arm(name, trials=4, labels={"part": name, "base": base, "what": what}, preset_name=base),
        preset=PAPER.model_copy(update={"episodes": most}),
    )
    for name, (base, what, most) in OF.items()
}
TRIALS = [
    made_trial(arm, scenario, number, [(played - 1, 21.0)] if played else [(30, 14.0)], updates=1000 * number)
    for name, arm in ARMS.items()
    for scenario in (LINE, ZIGZAG)
    for number, played in enumerate(PLAYED[name])
]
FOUND = {arm: measures_of(own) for (arm, on), own in on_each(TRIALS).items() if on == "line"}
REPORT = report(made_config("ablation", TRIALS), TRIALS)
TEXT = "\n\n".join(REPORT.text)


def cells_of(name: str) -> list[str]:
    line = next(line for line in TEXT.splitlines() if line.startswith(f"| {name} "))
    return [cell.strip() for cell in line.replace(r"\|", "/")[1:-1].split("|")]


def test_measures_keep_the_order_of_parts_and_their_own_trials() -> None:
    assert list(FOUND) == ["whole", "no | hope", "old"]
    assert FOUND["whole"].played.tolist() == [5, 7, 6, 9]
    assert (FOUND["whole"].solved, FOUND["whole"].median, FOUND["whole"].worst) == (4, 6.5, 9)
    assert FOUND["whole"].updates == 1500


def test_a_trial_that_was_never_at_the_optimum_counts_as_infinite() -> None:
    hopeless = FOUND["no | hope"]
    assert (hopeless.solved, hopeless.median, hopeless.worst) == (1, math.inf, math.inf)
    assert hopeless.best_score == 21.0


def test_a_medians_interval_contains_the_median_and_lies_within_the_trials() -> None:
    interval = FOUND["old"].interval
    assert interval is not None
    assert 30 <= interval.low <= FOUND["old"].median <= interval.high <= 200
    hopeless = FOUND["no | hope"].interval
    assert hopeless is not None
    assert hopeless.high == math.inf


def test_each_table_line_has_the_figures_of_its_part() -> None:
    assert cells_of("whole")[:3] == ["whole", "", "4 of 4"]
    assert cells_of("whole")[3].startswith("6.5 (5 to ")
    assert cells_of("whole")[4:] == ["9", "21", "1,500", "200"]
    assert cells_of("old")[-1] == "3,000"


def test_the_table_shows_never_as_infinity_and_escapes_bars_in_names() -> None:
    cells = cells_of(r"no \| hope")
    assert cells[:3] == ["no / hope", "nothing is imagined to pay", "1 of 4"]
    assert cells[3].startswith("∞")
    assert cells[4] == "∞"


def test_the_report_says_that_model_based_has_no_imitation() -> None:
    assert "`model-based` is double Q-learning alone: there is no imitation in it" in TEXT
    assert "4 trials of each line on each design, seed 0" in TEXT
    assert "](ablation.png)" in TEXT
    assert "## zig|zag, optimum 21" in TEXT


def test_the_same_trials_give_the_same_files(tmp_path: Path) -> None:
    for folder in (tmp_path / "one", tmp_path / "two"):
        folder.mkdir()
        write_report(folder, STUDY, report(made_config("ablation", TRIALS), TRIALS))
    for name in STUDY.files.values():
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_the_csv_file_has_a_row_per_trial_and_an_empty_cell_for_never(tmp_path: Path) -> None:
    write_report(tmp_path, STUDY, REPORT)
    rows = table(tmp_path / "ablation.csv")
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == 24
    hopeless = [row for row in rows if (row["part"], row["scenario"]) == ("no | hope", "line")]
    assert [row["played_to_optimum"] for row in hopeless] == ["", "", "20", ""]


def test_the_picture_shows_the_colours_of_trials_medians_and_never(tmp_path: Path) -> None:
    write_report(tmp_path, STUDY, REPORT)
    picture = (imread(tmp_path / "ablation.png")[..., :3] * 255).round().astype(int).reshape(-1, 3)
    for colour in ("56B4E9", "0072B2", "D55E00"):
        wanted = [int(colour[at : at + 2], 16) for at in (0, 2, 4)]
        assert (picture == wanted).all(axis=1).sum() > 50, colour
