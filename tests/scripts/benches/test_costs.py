"""The bench of the agents' costs: ratios with their verdicts, and whole trainings by turns."""

import pytest

from scripts.bench import main
from scripts.benches.costs import compared


@pytest.mark.parametrize(
    ("theirs", "verdict"),
    [
        ([2.0] * 5, "holds"),
        ([1.0] * 5, "undecided, within a tenth"),
        ([1.05] * 5, "undecided, within a tenth"),
        ([0.5, 2.0, 0.5, 2.0, 1.0], "undecided"),
        ([0.5] * 5, "does not hold"),
        ([2.0] * 4, "undecided"),  # four signs can be chosen in 16 ways: too few for 0.05
    ],
)
def test_nested_is_quicker_only_where_it_is_shown_by_more_than_a_tenth(theirs: list[float], verdict: str) -> None:
    assert compared([1.0] * len(theirs), theirs)["verdict"] == verdict


def test_the_ratio_is_the_geometric_mean_of_the_rounds_with_its_interval() -> None:
    found = compared([1.0, 4.0], [1.0, 1.0])
    assert found["ratio"] == 2.0
    assert found["low"] < 2.0 < found["high"]


def test_each_agent_trains_once_a_round_and_compiling_stands_by_itself(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["costs", "--trials", "1", "--episodes", "2", "--rounds", "2"]
    assert main(words) == 0
    shown = capsys.readouterr().out
    for name in ("compiling_s", "seconds", "i1", "i2", "than single", "undecided"):
        assert name in shown


def test_a_bench_of_no_rounds_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["costs", "--rounds", "0"])
    assert ended.value.code == 2
    assert "--rounds take 1 or more" in capsys.readouterr().err
