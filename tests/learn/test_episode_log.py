"""The rows of a training's log survive being saved as a table."""

from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow, rows_of_table, table_of_rows


def test_rows_come_back_from_their_table_with_their_types() -> None:
    rows = [EpisodeRow(0, 1, -4.5, 1, 60, 1.0, 0.25), EpisodeRow(2, 7, 21.0, 0, 13, 0.01, 0.001)]
    found = rows_of_table(table_of_rows(rows, EpisodeRow), EpisodeRow)
    assert found == rows
    assert [type(value) for value in found[0]] == [int, int, float, int, int, float, float]


def test_an_empty_log_becomes_an_empty_table_with_its_columns() -> None:
    assert table_of_rows([], EvaluationRow).shape == (0, 5)
    assert rows_of_table(table_of_rows([], EvaluationRow), EvaluationRow) == []
