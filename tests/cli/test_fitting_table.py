"""Tables for a terminal of any width."""

import io

from rich.console import Console
from rich.text import Text

from mc_nested.cli.fitting_table import FittingTable, facts_table

ROWS = [
    {"run": Text("line"), "episodes": Text("3,000"), "size": Text("19 MB")},
    {"run": Text("zigzag"), "episodes": Text("20"), "size": Text("1 MB")},
]
TABLE = FittingTable(ROWS, left_out=("size", "episodes"), numbers=("episodes",))


def shown(width: int) -> list[str]:
    text = io.StringIO()
    Console(file=text, width=width).print(TABLE)
    return [line.rstrip() for line in text.getvalue().splitlines()]


def test_where_there_is_room_every_column_is_shown_numbers_to_the_right() -> None:
    assert shown(80) == ["run     episodes  size", "line       3,000  19 MB", "zigzag        20  1 MB"]


def test_where_there_is_none_the_least_needed_are_left_out_first() -> None:
    assert shown(20) == ["run     episodes", "line       3,000", "zigzag        20"]
    assert shown(10) == ["run", "line", "zigzag"]


def test_what_still_does_not_fit_is_folded_and_nothing_is_lost() -> None:
    assert "".join(shown(4)) == "runlinezigzag"


def test_facts_that_say_nothing_are_left_out() -> None:
    text = io.StringIO()
    Console(file=text, width=80).print(facts_table([("state", "finished"), ("why", "")]))
    assert text.getvalue().split() == ["state", "finished"]
