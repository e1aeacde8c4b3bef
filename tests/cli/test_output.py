"""--quiet and --json: what goes to which stream."""

import io
import json
import sys
from pathlib import Path

import pytest
from rich.table import Table

from mc_nested.cli.output import Output
from mc_nested.cli.progress_line import print_line


def said(output: Output, capsys: pytest.CaptureFixture[str]) -> tuple[str, str]:
    """What a verb prints on both streams."""
    output.note("begins")
    print_line(output.progress, "half of it")
    output.result({"folder": Path("runs/x"), "scores": [21.0, float("inf")], "is_done": True, "why": None}, "done")
    output.hint("look at it")
    printed = capsys.readouterr()
    return printed.out, printed.err


def test_a_person_sees_everything(capsys: pytest.CaptureFixture[str]) -> None:
    assert said(Output(), capsys) == ("begins\ndone\nlook at it\n", "half of it\n")


def test_quiet_leaves_the_result(capsys: pytest.CaptureFixture[str]) -> None:
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


def test_a_table_is_shown_to_a_person_as_wide_as_it_needs(capsys: pytest.CaptureFixture[str]) -> None:
    table = Table("head")
    table.add_row("x" * 100)
    Output().result({}, table)
    assert "x" * 100 in capsys.readouterr().out


def test_a_note_that_nobody_reads_any_more_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone(io.StringIO):
        def write(self, _: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Gone())
    Output().note("begins")
