"""The rows of a benchmark, and how episodes to the optimum are counted."""

import csv
from pathlib import Path

import pytest

from mc_nested.report.benchmark_results import BenchmarkRow, played_to_optimum, write_rows
from tests.report.made_benchmark import made_benchmark, row


@pytest.mark.parametrize(
    ("evaluations", "played"),
    [
        ([(10, 3.0), (20, 20.0), (30, 20.0)], 22),
        ([(0, 20.0)], 1),
        ([(10, 3.0), (10, 20.0)], 12),
        ([(10, 3.0), (20, 19.0)], None),
        ([], None),
    ],
)
def test_every_episode_counts_the_greedy_ones_too(evaluations: list[tuple[int, float]], played: int | None) -> None:
    assert played_to_optimum(evaluations, 20.0) == played


def test_a_row_is_a_line_of_the_table_and_never_is_an_empty_cell(tmp_path: Path) -> None:
    write_rows(tmp_path / "rows.csv", [row("live", 4, 17), row("live", 5, None)])
    with (tmp_path / "rows.csv").open(newline="", encoding="utf-8") as file:
        first, second = csv.DictReader(file)
    assert tuple(first) == BenchmarkRow._fields
    assert (first["kind"], first["played_to_optimum"], first["without_a_prior"]) == ("corner", "17", "20.18")
    assert (second["kind"], second["played_to_optimum"], second["best_score"]) == ("scattered", "", "17.0")


def test_a_contestant_is_an_agent_with_a_preset() -> None:
    assert {each.contestant for each in made_benchmark().rows} == {"nested, quick", "nested, sl|ow"}
