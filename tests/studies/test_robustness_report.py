"""The verdicts under each choice: a table, a picture and the lines behind them, the same for the same results."""

import csv
from dataclasses import replace
from pathlib import Path

import cv2
import pytest

from mc_nested.studies.results import Results
from mc_nested.studies.robustness import STUDY, JudgedChoice, judged_under, report_on
from mc_nested.studies.study import write_report
from mc_nested.studies.verdicts import Verdict
from tests.studies.claims.made_results import level, made, the_papers

LETTERS = ["a1", "a2", "a3", "b", "c1", "c2", "c3", "c4", "d1", "d2", "e1", "e2", "g", "h"]


def behind() -> Results:
    """Return results as in the paper, but with the nested agent behind on the line at the end."""
    return made({**the_papers(), ("nested", "line"): level(15, early=12, spread=0.5)})


@pytest.fixture(scope="module")
def choices() -> list[JudgedChoice]:
    return [
        judged_under("", "", made(the_papers())),
        judged_under("start", "a|b", behind()),
        judged_under("γ", "0.9", made(the_papers())),
    ]


def text_of(choices: list[JudgedChoice]) -> str:
    return "\n\n".join(report_on(choices).text)


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split(" | ")]


def test_all_claims_but_those_of_longer_trainings_and_seconds_are_judged(choices: list[JudgedChoice]) -> None:
    assert [list(each.verdicts) for each in choices] == [LETTERS] * 3
    assert choices[0].verdicts["a2"] is Verdict.HOLDS
    assert choices[1].verdicts["a2"] is Verdict.FAILS


def test_a_verdict_that_differs_from_the_bases_is_bold(choices: list[JudgedChoice]) -> None:
    lines = text_of(choices).splitlines()
    base, changed, same = (
        cells(next(line for line in lines if line.startswith(f"| {name}")))
        for name in ("as it is", "start: a\\|b", "γ: 0.9")
    )
    assert base[1:4] == ["holds", "holds", "holds"]
    assert changed[1:4] == ["holds", "**does not hold**", "**does not hold**"]
    assert base[1:] == same[1:]


def test_each_claim_counts_its_verdicts_under_the_other_choices(choices: list[JudgedChoice]) -> None:
    line = next(line for line in text_of(choices).splitlines() if line.startswith("| (a2) |"))
    assert cells(line)[2:] == ["holds", "1", "0", "0", "1", "0"]


def test_scores_are_shown_with_the_optimum_of_the_choice(choices: list[JudgedChoice]) -> None:
    optimum = {**choices[0].results.optimum, "line": 17.0}
    lower = judged_under("designs", "smaller", replace(made(the_papers()), optimum=optimum))
    line = text_of([choices[0], lower]).splitlines()[-3]
    assert cells(line)[:2] == ["designs: smaller", "20.00, 17.00, 13.00 of 17"]


def test_the_csv_file_has_every_line_of_every_claim(choices: list[JudgedChoice], tmp_path: Path) -> None:
    write_report(tmp_path, STUDY, report_on(choices))
    with (tmp_path / "robustness.csv").open(newline="", encoding="utf-8") as file:
        header, *rows = list(csv.reader(file))
    expected = "choice,value,claim,line,measured,p,p_opposite,p_opposite_holm,p_small,verdict"
    assert header == expected.split(",")
    assert len(rows) == sum(len(judged.findings) for each in choices for judged in each.claims)
    row = next(row for row in rows if row[:3] == ["start", "a|b", "a2"])
    assert row[3:5] == ["line, final score", "-2.0"]
    assert row[-1] == "does not hold"
    assert float(row[6]) < 0.05 < float(row[5])


def test_the_picture_grows_with_the_choices_and_the_files_are_repeatable(
    choices: list[JudgedChoice], tmp_path: Path
) -> None:
    sizes = []
    for name, some in (("one", choices), ("two", choices), ("few", choices[:2])):
        (tmp_path / name).mkdir()
        write_report(tmp_path / name, STUDY, report_on(some))
        picture = cv2.imread(str(tmp_path / name / "robustness.png"))
        assert picture is not None
        sizes.append(picture.shape)
    assert sizes[2][0] < sizes[0][0]
    for file in ("robustness.png", "robustness.md", "robustness.csv"):
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()
    assert (tmp_path / "one" / "robustness.png").read_bytes() != (tmp_path / "few" / "robustness.png").read_bytes()
