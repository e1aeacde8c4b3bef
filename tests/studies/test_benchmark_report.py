"""The report of a benchmark: every contestant over all designs and on each kind, the same for the same trials."""

from pathlib import Path

import cv2
import pytest

from mc_nested.arena.design import KINDS
from mc_nested.studies.benchmark import COLUMNS, STUDY, report
from mc_nested.studies.study import write_report
from tests.cli.running import table
from tests.studies.made_benchmark import contestant, made_benchmark, played
from tests.studies.made_trials import made_config

TRIALS = made_benchmark()


@pytest.fixture(scope="module")
def text() -> str:
    return "\n\n".join(report(made_config("benchmark", TRIALS, 4), TRIALS).text)


def test_the_report_names_the_designs_trials_seconds_and_updates(text: str) -> None:
    blocks = [trial.scenario.blocks for trial in TRIALS]
    assert f"12 designs of {min(blocks)} to {max(blocks)} blocks drawn from seed 4. 2 trials on each, seed 4." in text
    assert "Agarwal et al., Deep Reinforcement Learning at the Edge of the Statistical Precipice" in text
    assert "Seconds of one core a trial, median: nested, quick 2.0 (at most 3.0); nested, sl|ow 20.0" in text
    assert "Updates of a trial, median: nested, quick 1,000; nested, sl|ow 1,000." in text


def test_the_report_has_a_table_over_all_designs_and_one_for_each_kind(text: str) -> None:
    tables = text.split("| agent, preset |")[1:]
    assert len(tables) == 1 + len(KINDS)
    for kind in KINDS:
        assert f"## {kind}: " in text
    assert "| nested, quick | 24 of 24 |" in tables[0]
    assert "| nested, quick | 8 of 8 |" in tables[1]


def test_a_bar_in_a_name_does_not_break_the_table(text: str) -> None:
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert {line.replace(r"\|", "").count("|") for line in lines} == {9}


def test_the_same_trials_give_the_same_three_report_files(tmp_path: Path) -> None:
    found = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        made = report(made_config("benchmark", TRIALS), TRIALS)
        write_report(tmp_path / name, STUDY, made)
        first = made.found["measures"][0]
        assert (first["contestant"], first["solved"]) == ("nested, quick", 24)
        found.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert found[0] == found[1]
    assert set(found[0]) == {"benchmark.csv", "benchmark.md", "benchmark.png"}
    picture = cv2.imread(str(tmp_path / "first" / "benchmark.png"))
    assert picture is not None
    # Both contestants are drawn on either side, in their colours (BGR).
    for colour in ((0xB2, 0x72, 0x00), (0x00, 0x5E, 0xD5)):
        columns = (abs(picture.astype(int) - colour).max(axis=2) < 8).any(axis=0).nonzero()[0]
        assert columns.min() < picture.shape[1] / 2 < columns.max()


def test_a_report_can_be_written_with_nothing_solved_and_a_single_kind(tmp_path: Path) -> None:
    trials = [played(contestant("x", 5, trials=1, designs=1), 0, 0, None)]
    write_report(tmp_path, STUDY, report(made_config("benchmark", trials, corpus="mine.toml"), trials))
    text = (tmp_path / "benchmark.md").read_text("utf-8")
    blocks = trials[0].scenario.blocks
    assert f"one design of {blocks} blocks of `mine.toml`. One trial on each, seed 0." in text
    assert "##" not in text


def test_the_csv_file_has_a_row_per_trial_and_an_empty_cell_for_never(tmp_path: Path) -> None:
    arm = contestant("model-based", 30, trials=1, designs=2)
    trials = [played(arm, 0, 0, 17), played(arm, 1, 0, None)]
    write_report(tmp_path, STUDY, report(made_config("benchmark", trials), trials))
    first, second = table(tmp_path / "benchmark.csv")
    assert tuple(first) == COLUMNS
    cells = trials[0].scenario.size * (trials[0].scenario.size - 1)
    without = round((cells + 1) / (trials[0].scenario.blocks + 1) + 1, 2)
    assert (first["kind"], first["played_to_optimum"], first["without_a_prior"]) == ("edge", "17", str(without))
    lacking = str(trials[1].scenario.optimum - 3)
    assert (second["kind"], second["played_to_optimum"], second["best_score"]) == ("corner", "", lacking)
