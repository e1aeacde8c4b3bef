"""--quiet and --json: which words go to which stream, and how tables fit."""

import io
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest
from rich.console import Console
from rich.table import Table
from rich.text import Text

from mc_nested.cli.output import FittingTable, Output, facts_table, print_line


@dataclass
class Found:
    folder: Path
    scores: list[float]
    is_done: bool
    why: str | None


def said(output: Output, capsys: pytest.CaptureFixture[str]) -> tuple[str, str]:
    """Return what a verb prints on both streams."""
    output.note("begins")
    print_line(output.progress, "half of it")
    output.result(Found(Path("runs/x"), [21.0, float("inf")], True, None), "done")
    output.hint("look at it")
    printed = capsys.readouterr()
    return printed.out, printed.err


def test_without_quiet_or_json_everything_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert said(Output(), capsys) == ("begins\ndone\nlook at it\n", "half of it\n")


def test_quiet_prints_only_the_result(capsys: pytest.CaptureFixture[str]) -> None:
    assert said(Output(quiet=True), capsys) == ("done\n", "")


def test_json_is_one_object_and_nothing_else_on_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    out, err = said(Output(as_json=True), capsys)
    assert json.loads(out) == {"folder": str(Path("runs/x")), "scores": [21.0, None], "is_done": True, "why": None}
    assert out.count("\n") == 1
    assert err == "begins\nhalf of it\n"


def test_quiet_json_is_the_object_alone(capsys: pytest.CaptureFixture[str]) -> None:
    out, err = said(Output(quiet=True, as_json=True), capsys)
    assert json.loads(out)["is_done"] is True
    assert err == ""


def test_table_is_printed_as_wide_as_its_content(capsys: pytest.CaptureFixture[str]) -> None:
    table = Table("head")
    table.add_row("x" * 100)
    Output().result(None, table)
    assert "x" * 100 in capsys.readouterr().out


def test_note_to_a_closed_pipe_does_not_stop_the_verb(monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone(io.StringIO):
        def write(self, _: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Gone())
    Output().note("begins")


ROWS = [
    {"run": Text("line"), "episodes": Text("3,000"), "size": Text("19 MB")},
    {"run": Text("zigzag"), "episodes": Text("20"), "size": Text("1 MB")},
]
TABLE = FittingTable(ROWS, left_out=("size", "episodes"), numbers=("episodes",))


def shown(width: int) -> list[str]:
    text = io.StringIO()
    Console(file=text, width=width).print(TABLE)
    return [line.rstrip() for line in text.getvalue().splitlines()]


def test_table_shows_every_column_if_there_is_room_and_aligns_numbers_right() -> None:
    assert shown(80) == ["run     episodes  size", "line       3,000  19 MB", "zigzag        20  1 MB"]


def test_table_drops_the_least_needed_columns_first_if_room_is_short() -> None:
    assert shown(20) == ["run     episodes", "line       3,000", "zigzag        20"]
    assert shown(10) == ["run", "line", "zigzag"]


def test_table_that_still_does_not_fit_is_folded_without_loss() -> None:
    assert "".join(shown(4)) == "runlinezigzag"


def test_empty_facts_are_left_out() -> None:
    text = io.StringIO()
    Console(file=text, width=80).print(facts_table([("state", "finished"), ("why", "")]))
    assert text.getvalue().split() == ["state", "finished"]
