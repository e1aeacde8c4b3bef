"""results.csv: written and read back exactly, and refused where it is something else."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import RunError
from mc_nested.report.results import Evaluation, read_evaluations, write_evaluations

NAMES = st.text(st.characters(exclude_categories=["Cs", "Cc"]), min_size=1)
COUNTS = st.integers(0, 10**6)
SCORES = st.floats(-1e6, 1e6, allow_nan=False)


def test_the_table_is_plain_csv_with_unix_line_ends(tmp_path: Path) -> None:
    path = tmp_path / "results.csv"
    write_evaluations(path, [Evaluation("nested", "line", 3, 30, 20.5, "stone", 13)])
    assert path.read_bytes() == b"agent,scenario,trial,episode,score,material,steps\nnested,line,3,30,20.5,stone,13\n"


@given(rows=st.lists(st.builds(Evaluation, NAMES, NAMES, COUNTS, COUNTS, SCORES, NAMES, COUNTS)))
def test_what_is_written_is_read_back(tmp_path_factory: pytest.TempPathFactory, rows: list[Evaluation]) -> None:
    path = tmp_path_factory.mktemp("table") / "results.csv"
    write_evaluations(path, rows)
    assert read_evaluations(path) == rows


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "the first line"),
        ("agent,scenario\n", "the first line"),
        ("agent,scenario,trial,episode,score,material,steps\nnested,line,0,30,high,stone,13\n", "row 1"),
        ("agent,scenario,trial,episode,score,material,steps\nnested,line,0\n", "row 1"),
    ],
)
def test_another_file_is_refused_in_one_line(tmp_path: Path, text: str, said: str) -> None:
    path = tmp_path / "results.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(RunError, match=said) as refused:
        read_evaluations(path)
    assert "\n" not in str(refused.value)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"results\.csv: can't be read"):
        read_evaluations(tmp_path / "results.csv")
