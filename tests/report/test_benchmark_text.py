"""benchmark.md: every contestant over all designs, and on each kind."""

import pytest

from mc_nested.arena.design import KINDS
from mc_nested.report.benchmark_measures import measures_of, trials_of
from mc_nested.report.benchmark_text import benchmark_text
from tests.report.made_benchmark import made_benchmark


@pytest.fixture(scope="module")
def text() -> str:
    made = made_benchmark()
    return benchmark_text(made, [(name, measures_of(trials_of(made, name))) for name in made.most_episodes])


def test_it_says_what_was_measured(text: str) -> None:
    assert "12 designs of 5 to 16 blocks drawn from seed 4. 2 trials on each, seed 4." in text
    assert "Agarwal et al., Deep Reinforcement Learning at the Edge of the Statistical Precipice" in text
    assert "Seconds of one core a trial, median: nested, quick 2.0 (at most 3.0); nested, sl|ow 20.0" in text
    assert "Updates of a trial, median: nested, quick 1,000; nested, sl|ow 1,000." in text


def test_there_is_a_table_over_all_and_one_for_each_kind(text: str) -> None:
    tables = text.split("| agent, preset |")[1:]
    assert len(tables) == 1 + len(KINDS)
    for kind in KINDS:
        assert f"## {kind}: " in text
    assert "| nested, quick | 24 of 24 |" in tables[0]
    assert "| nested, quick | 8 of 8 |" in tables[1]


def test_a_bar_in_a_name_does_not_break_the_table(text: str) -> None:
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    assert {line.replace(r"\|", "").count("|") for line in lines} == {9}
