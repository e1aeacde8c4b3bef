"""A table as CSV, and as Markdown."""

from pathlib import Path

from mc_nested.studies.table import Table, episodes, markdown_of


def test_the_table_is_plain_csv_with_unix_line_ends(tmp_path: Path) -> None:
    Table(("agent", "score"), [("nested", 20.5), ("a, b", None)]).write(tmp_path / "table.csv")
    assert (tmp_path / "table.csv").read_bytes() == b'agent,score\nnested,20.5\n"a, b",\n'


def test_numbers_of_episodes_are_whole_from_a_hundred_on_and_infinity_for_never() -> None:
    assert [episodes(number) for number in (6.5, 9.0, 1234.5, float("inf"))] == ["6.5", "9", "1,234", "∞"]


def test_a_row_that_names_its_columns_makes_the_header_too() -> None:
    rows = [[("agent", "nested"), ("score", "1|2")], [("agent", "single"), ("score", "3")]]
    assert markdown_of(rows) == "| agent | score |\n| --- | --- |\n| nested | 1\\|2 |\n| single | 3 |"


def test_without_a_row_there_is_no_table() -> None:
    assert markdown_of([]) == ""
