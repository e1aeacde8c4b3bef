"""report.md: what it says is what was judged, and it says the same of the same results."""

from dataclasses import replace

import pytest

from mc_nested.report.claims.judge import judge
from mc_nested.report.report_text import report_text
from mc_nested.report.results import Results
from tests.report.made_results import level, made, the_papers


def text_of(results: Results, longer: Results | None = None) -> str:
    return report_text(results, judge(results, longer), longer)


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split("|")]


@pytest.fixture(scope="module")
def lines() -> list[str]:
    return text_of(made(the_papers())).splitlines()


def test_the_headline_table_has_every_agent_and_scenario(lines: list[str]) -> None:
    headline = [line for line in lines if "** of " in line]
    assert len(headline) == 9
    scenario, agent, final, interval, solved, share, early, spread = cells(headline[0])
    assert (scenario, agent, final, interval) == ("line", "nested", "**20.00** of 21", "19.92 to 20.08")
    assert (solved, share) == ("0 of 6", "0.00 to 0.46")  # 1 - 0.025 ** (1 / 6)
    assert (early, spread) == ("12.00", "0.50")


def test_every_claim_has_its_quote_its_section_and_its_verdict() -> None:
    results = made(the_papers("line"))
    text = text_of(results)
    for judged in judge(results):
        assert f"### ({judged.claim.letter}) {judged.claim.title}: {judged.verdict.value}\n" in text
        assert f"| ({judged.claim.letter}) | {judged.claim.title} | **{judged.verdict.value}** |" in text
        assert f'section {judged.claim.section}: "{judged.claim.paper}"' in text


def test_a_finding_has_figures_interval_both_p_and_holm(lines: list[str]) -> None:
    finding = next(line for line in lines if line.startswith("| line, early score"))
    assert cells(finding) == [
        "line, early score",
        "nested 12.00, hierarchical 7.00, difference 5.00",
        "5.00 to 5.00",
        "0.0011 / 1",  # one of the 924 splits of six and six
        "0.0390 / 1",  # 36 tests: a 2, b 4, c 6, d 6, each for and against
        "holds",
    ]


def test_the_costs_stand_beside_the_nested_agents(lines: list[str]) -> None:
    assert "| zigzag | nested | 2 | 3,000 | 1,200 | 1,000 |" in lines
    assert "| zigzag | hierarchical | 3 (1.50) | 4,500 (1.50) | 1,200 (1.00) | 1,000 (1.00) |" in lines


def test_only_the_line_of_seconds_differs_where_the_same_took_longer() -> None:
    results = made(the_papers("line"))
    slower = replace(results, costs=[cost._replace(seconds=99.0) for cost in results.costs])
    fast_lines, slow_lines = text_of(results).splitlines(), text_of(slower).splitlines()
    differing = [line for line, slow in zip(fast_lines, slow_lines, strict=True) if line != slow]
    assert len(differing) == 1
    assert differing[0].startswith("Seconds")
    assert "nested 2.5, hierarchical 2.5, single 2.5" in differing[0]


def test_without_the_long_run_its_claim_was_not_run(lines: list[str]) -> None:
    assert "### (f) more episodes bring the zigzag and the diamond to the optimum: not run" in lines
    assert any("needs a second run with ten times the episodes" in line for line in lines)


def test_the_long_run_is_named() -> None:
    text = text_of(made(the_papers("zigzag")), made(the_papers("zigzag"), episodes=900))
    assert "A second run, of 900 episodes" in text
    assert "share after 90 episodes 0.00, share after 900 episodes 0.00" in text


def test_a_single_trial_makes_a_report_without_numbers_that_are_none() -> None:
    results = made({key: trials[:1] for key, trials in the_papers().items()})
    text = text_of(results, results)
    assert "a single trial can't be tested" in text
    assert "nan" not in text
    assert "inf" not in text


def test_too_few_trials_are_said_to_be_too_few(lines: list[str]) -> None:
    few = made({key: trials[:5] for key, trials in the_papers().items()})
    # Five of ten can be drawn in 252 ways, and 36 / 252 is more than 0.05; 36 / 924 for six is less.
    assert "With 5 trials no permutation test can come below 0.0040, which is too much for 36 tests" in text_of(few)
    assert not any("no permutation test can" in line for line in lines)


def test_a_scenarios_name_can_not_break_the_tables() -> None:
    results = made({("nested", "line"): level(20)})
    text = text_of(
        replace(
            results,
            scenarios=["a|b"],
            optimum={"a|b": 21.0},
            builder={"a|b": 21.0},
            evaluations=[row._replace(scenario="a|b") for row in results.evaluations],
            costs=[],
        )
    )
    assert "| a\\|b | nested |" in text


def test_the_costs_are_listed_scenario_by_scenario() -> None:
    text = report_text(made(the_papers("line", "zigzag")), judge(made(the_papers("line", "zigzag"))))
    costs = text[text.index("| scenario | agent | networks |") :].splitlines()[2:]
    rows = [row.split(" | ")[0].removeprefix("| ") for row in costs if row.startswith("|")]
    assert rows == ["line"] * 3 + ["zigzag"] * 3
