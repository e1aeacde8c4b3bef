"""The report of a sweep: the effect of each choice beside its own agent's base, table, figure."""

import csv
from pathlib import Path

import cv2
import pytest

from mc_nested.studies.inference import Interval
from mc_nested.studies.study import write_report
from mc_nested.studies.sweep import STUDY, effects_on, report
from mc_nested.studies.trial import Trial
from tests.full_disk import full_disk
from tests.studies.made_trials import LINE, ZIGZAG, made_arm, made_config, made_trial


def trials_of(agent: str, choice: str, value: str, finals: list[float]) -> list[Trial]:
    """Return trials with those final scores on both designs, two worse in the mean."""
    labels = {"agent": agent, "choice": choice, "value": value}
    arm = made_arm(f"{choice}: {value}" if choice else f"base, {agent}", agent=agent, labels=labels)
    return [
        made_trial(arm, scenario, number, [(30, final - 4), (60, final)])
        for scenario in (LINE, ZIGZAG)
        for number, final in enumerate(finals)
    ]


TRIALS = [
    *trials_of("nested", "", "", [20, 21, 21]),
    *trials_of("single", "", "", [10, 10, 10]),
    *trials_of("nested", "γ", "0.5", [15, 15, 15]),
    *trials_of("nested", "rate", "1e-3", [21, 20, 21]),
    *trials_of("single", "state", "blind", [12, 12, 12]),
]
REPORT = report(made_config("sweep", TRIALS), TRIALS)
TEXT = "\n\n".join(REPORT.text)


def line_of(choice: str) -> list[str]:
    return next(
        [cell.strip() for cell in line.split("|")[1:-1]] for line in TEXT.splitlines() if f"| {choice} |" in line
    )


def test_a_change_is_compared_with_the_base_of_its_own_agent() -> None:
    effects = {(effect.arm.agent, effect.choice): effect for effect in effects_on(TRIALS, "line")}
    assert list(effects) == [("nested", ""), ("single", ""), ("nested", "γ"), ("nested", "rate"), ("single", "state")]
    worse, better = effects["nested", "γ"], effects["single", "state"]
    assert worse.final_difference == pytest.approx(15 - 62 / 3)
    assert worse.mean_difference == pytest.approx(13 - 56 / 3)
    assert (better.final_difference, better.final_interval) == (2.0, Interval(2.0, 2.0))
    assert worse.final_interval
    # Of 20, 21, 21 the error is 1 / 3; t with two degrees of freedom is 4.3027 at 0.975.
    assert worse.final_interval.low == pytest.approx(15 - 62 / 3 - 4.3027 / 3, abs=1e-4)
    assert worse.final_interval.high < 0


def test_a_base_has_no_effect_and_no_interval() -> None:
    base = effects_on(TRIALS, "line")[0]
    assert (base.final_difference, base.mean_difference) == (0.0, 0.0)
    assert base.final_interval is base.mean_interval is None


def test_the_same_scores_in_another_order_have_an_interval_around_0() -> None:
    interval = next(effect for effect in effects_on(TRIALS, "line") if effect.choice == "rate").final_interval
    assert interval
    assert interval.low < 0 < interval.high


def test_a_single_trial_has_no_interval() -> None:
    alone = [trial for trial in TRIALS if trial.number == 0]
    assert all(effect.final_interval is None for effect in effects_on(alone, "line"))


def test_each_table_line_has_the_figures_of_its_change() -> None:
    cells = line_of("state")
    assert cells[:4] == ["single", "state", "blind", "12.00"]
    assert cells[4:6] == ["+2.00", "+2.00 to +2.00"]
    assert cells[6:9] == ["10.00", "+2.00", "+2.00 to +2.00"]
    assert cells[9:] == ["12", "0 of 3", ""]
    assert line_of("rate")[10:] == ["2 of 3", "60"]


def test_the_table_line_of_a_base_has_no_differences() -> None:
    assert line_of(r"**base**")[:6] == ["nested", "**base**", "", "20.67", "", ""]


def test_the_report_names_the_preset_the_trials_and_the_number_of_intervals() -> None:
    assert "the preset `paper`, seed 0: 3 trials of 90 episodes" in TEXT
    assert "of 12 some 1 leave out 0" in TEXT
    assert "## zig|zag, optimum 21" in TEXT
    assert "](sweep.png)" in TEXT


def test_the_same_trials_give_the_same_three_report_files(tmp_path: Path) -> None:
    found = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        write_report(tmp_path / name, STUDY, report(made_config("sweep", TRIALS), TRIALS))
        found.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert found[0] == found[1]
    assert set(found[0]) == {"sweep.csv", "sweep.md", "sweep.png"}
    picture = cv2.imread(str(tmp_path / "first" / "sweep.png"))
    assert picture is not None
    # A point left of the base in one panel at least, in the colour of final scores (BGR).
    assert (abs(picture.astype(int) - (0xB2, 0x72, 0x00)).max(axis=2) < 8).any()


def test_the_csv_file_has_a_row_per_trial_and_an_empty_cell_for_never(tmp_path: Path) -> None:
    write_report(tmp_path, STUDY, REPORT)
    with (tmp_path / "sweep.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    expected = "agent,choice,value,scenario,trial,final_score,best_score,mean_score,episodes_to_optimum"
    assert header == expected.split(",")
    assert rows[:2] == [
        ["nested", "", "", "line", "0", "20.0", "20.0", "18.0", ""],
        ["nested", "", "", "line", "1", "21.0", "21.0", "19.0", "60"],
    ]
    assert len(rows) == 2 * 5 * 3


def test_a_full_disk_leaves_the_old_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_report(tmp_path, STUDY, REPORT)
    before = (tmp_path / "sweep.png").read_bytes()

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", full_disk)
    with pytest.raises(OSError, match="no space left"):
        write_report(tmp_path, STUDY, REPORT)
    assert (tmp_path / "sweep.png").read_bytes() == before
    assert {path.name for path in tmp_path.iterdir()} == {"sweep.csv", "sweep.md", "sweep.png"}
