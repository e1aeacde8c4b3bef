"""Small pieces of Markdown."""

from scripts.documentation.markdown_text import code, number, of_docstring, sentence, table


def test_table_escapes_pipes_only_outside_code() -> None:
    rows = [["`NAME|FILE`", "one | two"]]
    assert table(["a", "b"], rows) == "| a | b |\n| --- | --- |\n| `NAME|FILE` | one \\| two |\n"


def test_line_breaks_in_a_table_cell_become_blanks() -> None:
    assert "| one two |" in table(["a"], [["one\n  two"]])


def test_long_code_is_shortened_and_a_back_quote_is_quoted() -> None:
    assert code("--out DIR") == "`--out DIR`"
    assert code("x" * 61) == "`" + "x" * 59 + "…`"
    assert code("a`b") == "`` a`b ``"


def test_docstring_becomes_markdown_with_links_to_the_pages_that_it_names() -> None:
    text = "What ``step`` does\n    (docs/explanation/task.md)."
    assert of_docstring(text) == "What `step` does\n([task](../explanation/task.md))."
    assert of_docstring(None) == ""


def test_a_sentence_begins_with_a_capital_letter_where_it_begins_with_a_word() -> None:
    assert sentence("opens the chat") == "Opens the chat."
    assert sentence("γ: what a reward is worth") == "γ: what a reward is worth."
    assert sentence("is it so?") == "Is it so?"
    assert sentence("") == ""


def test_whole_number_is_written_without_decimals() -> None:
    assert [number(value) for value in (15, 1_000_000_000, 0.5, -1_000_000.0)] == [
        "15",
        "1,000,000,000",
        "0.5",
        "-1,000,000",
    ]
