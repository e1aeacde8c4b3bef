"""A table as CSV."""

from pathlib import Path

from mc_nested.studies.table import Table, episodes


def test_the_table_is_plain_csv_with_unix_line_ends(tmp_path: Path) -> None:
    Table(("agent", "score"), [("nested", 20.5), ("a, b", None)]).write(tmp_path / "table.csv")
    assert (tmp_path / "table.csv").read_bytes() == b'agent,score\nnested,20.5\n"a, b",\n'


def test_numbers_of_episodes_are_whole_from_a_hundred_on_and_infinity_for_never() -> None:
    assert [episodes(number) for number in (6.5, 9.0, 1234.5, float("inf"))] == ["6.5", "9", "1,234", "∞"]
