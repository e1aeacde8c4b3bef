"""report.md: it says what was judged, and the same for the same results."""

from dataclasses import replace
from pathlib import Path

import pytest

from mc_nested.studies.claims.judge import judge
from mc_nested.studies.reproduce import STUDY, report_on
from mc_nested.studies.results import Results
from mc_nested.studies.study import write_report
from mc_nested.studies.table import Table
from tests.studies.claims.made_results import Trial, level, made, the_papers


def text_of(results: Results, longer: Results | None = None) -> str:
    return "\n\n".join(report_on(results, longer, {}).text)


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


@pytest.fixture(scope="module")
def lines() -> list[str]:
    return text_of(made(the_papers())).splitlines()


def test_the_headline_table_has_every_agent_and_scenario(lines: list[str]) -> None:
    headline = [line for line in lines if "** of " in line]
    assert len(headline) == 9
    scenario, agent, final, interval, last, last_interval, solved, share, early, spread = cells(headline[0])
    # Half of the trials an eighth above and half below: deviation 0.1318, and t with nine degrees of freedom 2.2622.
    # The mean is held unless one of ten draws or none is of one kind: 22 / 1,024.
    assert (scenario, agent, final, interval) == ("line", "nested", "**20.00** of 21", "19.91 to 20.09 (held 98 %)")
    assert (last, last_interval) == ("20.00", "19.91 to 20.09 (held 98 %)")
    assert (solved, share) == ("0 of 10", "0.00 to 0.31")  # 1 - 0.025 ** (1 / 10)
    assert (early, spread) == ("12.00", "0.50")


def test_trials_of_which_half_are_at_the_optimum_are_counted_and_have_no_interval_of_their_mean() -> None:
    at_optimum = [Trial(12, 21, 0)] * 9 + [Trial(12, 15, 0)]
    row = next(line for line in text_of(made({("nested", "line"): at_optimum})).splitlines() if "** of 21" in line)
    # Clopper and Pearson's interval of 9 of 10.
    counted = "9 of 10 at 21, share 0.55 to 1.00"
    assert cells(row)[2:6] == ["**20.40** of 21", counted, "20.40", counted]


def test_the_text_below_the_picture_says_how_often_its_bands_hold_the_mean(lines: list[str]) -> None:
    assert any(line.startswith("The bands are 95 % intervals of the mean. There is none where half") for line in lines)
    one_trial = text_of(made({key: trials[:1] for key, trials in the_papers().items()}))
    assert "The bands are" not in one_trial


def test_every_claim_has_its_quote_its_section_and_its_verdict() -> None:
    results = made(the_papers("line"))
    text = text_of(results)
    for judged in judge(results):
        assert f"### ({judged.claim.letter}) {judged.claim.title}: {judged.words}\n" in text
        assert f"| ({judged.claim.letter}) | {judged.claim.title} | **{judged.words}** |" in text
        assert f'section {judged.claim.section}: "{judged.claim.paper}"' in text


def test_a_finding_shows_figures_interval_and_its_p_values(lines: list[str]) -> None:
    finding = next(line for line in lines if line.startswith("| line, early score"))
    assert cells(finding) == [
        "line, early score",
        "nested 12.00, hierarchical 7.00, difference 5.00",
        "5.00 to 5.00",  # without width: none of the trials differs
        "0.0010",  # one of the 1,024 choices of the signs
        "1",
        "1",
        "1",
        "holds",
    ]


def test_the_p_value_of_the_opposite_stands_beside_its_correction() -> None:
    behind = {"nested": 4.5, "hierarchical": 5.0, "single": 5.0}
    early = {key: [trial._replace(early=behind[key[0]]) for trial in own] for key, own in the_papers().items()}
    lines = text_of(made(early)).splitlines()
    section = lines[next(at for at, line in enumerate(lines) if line.startswith("### (g)")) :]
    finding = next(line for line in section if line.startswith("| line, early score"))
    assert cells(finding)[3:] == ["1", "0.0010", "0.0029", "0.0029", "does not hold"]  # three lines: 3 / 1,024


def test_costs_are_shown_with_their_ratio_to_the_nested_agents(lines: list[str]) -> None:
    assert "| zigzag | nested | 2 | 3,000 | 1,200 | 1,000 | 1.00 |" in lines
    assert "| zigzag | hierarchical | 3 (1.50) | 4,500 (1.50) | 1,200 (1.00) | 1,000 (1.00) | 1.30 |" in lines


def test_the_report_defines_the_final_score_by_the_kept_policy() -> None:
    results = made(the_papers("line"))
    assert "A final score is that of the last evaluation." in text_of(results)
    assert "A final score is that of the policy that is kept, the best" in text_of(replace(results, keeps_best=True))


def test_a_slower_run_changes_only_lines_about_seconds() -> None:
    results = made(the_papers("line"))
    slower = replace(results, costs={key: cost._replace(seconds=99.0) for key, cost in results.costs.items()})
    fast_lines, slow_lines = text_of(results).splitlines(), text_of(slower).splitlines()
    differing = [line for line, slow in zip(fast_lines, slow_lines, strict=True) if line != slow]
    assert all("seconds" in line.lower() for line in differing)
    assert "nested 6.6, hierarchical 10.0, single 4.6" in differing[-1]
    assert differing[-1].startswith("Seconds")


def test_claim_f_is_not_judged_without_the_long_run(lines: list[str]) -> None:
    assert "### (f) more episodes bring the zigzag and the diamond to the optimum: not judged" in lines
    assert any("needs a second run with ten times the episodes" in line for line in lines)


def test_the_report_names_the_long_run() -> None:
    text = text_of(made(the_papers("zigzag")), made(the_papers("zigzag"), episodes=900))
    assert "A second run, of 900 episodes" in text
    assert "share after 90 episodes 0.00, share after 900 episodes 0.00" in text


def test_the_report_of_a_single_trial_contains_no_nan_or_infinity() -> None:
    results = made({key: trials[:1] for key, trials in the_papers().items()})
    text = text_of(results, results)
    assert "a single trial can't be tested" in text
    assert "nan" not in text
    assert "inf" not in text


def test_the_report_says_when_trials_are_too_few_for_a_test(lines: list[str]) -> None:
    def few(trials: int) -> str:
        return text_of(made({key: own[:trials] for key, own in the_papers().items()}))

    # Four signs can be chosen in 16 ways, and 1 / 16 is not below 0.05.
    assert "With 4 trials no sign-flip test can come below 0.0625: no claim that rests on one can hold" in few(4)
    # Six in 64 ways: three lines are 3 / 64, less than 0.05, and four are more. (b) has six.
    assert "With 6 trials no sign-flip test can come below 0.0156: a claim of 4 tested lines or more" in few(6)
    assert not any("no sign-flip test can" in line for line in lines)


def test_a_scenarios_name_can_not_break_the_tables() -> None:
    results = made({("nested", "line"): level(20)})
    text = text_of(
        replace(
            results,
            scenarios=["a|b"],
            optimum={"a|b": 21.0},
            builder={"a|b": 21.0},
            curves={("nested", "a|b"): results.curves["nested", "line"]},
            costs={},
        )
    )
    assert "| a\\|b | nested |" in text


def test_the_costs_are_listed_scenario_by_scenario() -> None:
    text = text_of(made(the_papers("line", "zigzag")))
    costs = text[text.index("| scenario | agent | networks |") :].splitlines()[2:]
    rows = [row.split(" | ")[0].removeprefix("| ") for row in costs if row.startswith("|")]
    assert rows == ["line"] * 3 + ["zigzag"] * 3


def test_the_same_results_give_the_same_files_and_the_verdicts(tmp_path: Path) -> None:
    results, longer = made(the_papers("zigzag")), made(the_papers("zigzag"), episodes=900)
    found = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        report = report_on(results, longer, {"results.csv": Table(("agent",), [("nested",)])})
        write_report(tmp_path / name, STUDY, report)
        assert [each["verdict"] for each in report.found["claims"]] == [
            judged.verdict.value for judged in judge(results, longer)
        ]
        found.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert found[0] == found[1]
    assert set(found[0]) == {"results.csv", "figure5.png", "figure5.svg", "report.md"}
    assert b"](figure5.png)" in found[0]["report.md"]
    assert b"\r" not in found[0]["report.md"]
