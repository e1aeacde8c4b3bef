"""All benches have options, print their figures as a table or as JSON, and set an exit code."""

import importlib
import io
import json
from argparse import ArgumentParser, Namespace
from types import SimpleNamespace

import pytest
from rich.console import Console

from mc_nested.errors import UserError
from scripts import bench


def measured(options: Namespace) -> tuple[bench.Figures, bool]:
    if options.frames < 2:
        raise UserError("--frames must be at least 2")
    return {"frames": options.frames, "reader": {"wrong": 1}}, options.frames < 10


@pytest.fixture
def reader(monkeypatch: pytest.MonkeyPatch) -> None:
    def add_options(parser: ArgumentParser) -> None:
        parser.add_argument("--frames", type=int, default=4)

    made_up = SimpleNamespace(__doc__="Read frames.", add_options=add_options, measure=measured)
    monkeypatch.setattr(importlib, "import_module", {"scripts.benches.reader": made_up}.__getitem__)


@pytest.mark.parametrize("name", bench.BENCHES)
def test_each_bench_is_a_module_with_a_docstring_options_and_measure(name: str) -> None:
    module = importlib.import_module(f"scripts.benches.{name.replace('-', '_')}")
    parser = ArgumentParser()
    module.add_options(parser)
    assert module.__doc__
    assert parser.parse_args([])
    assert callable(module.measure)


@pytest.mark.usefixtures("reader")
def test_json_option_prints_one_object_and_a_wrong_figure_exits_with_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert bench.main(["reader", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"frames": 4, "reader": {"wrong": 1}}
    assert bench.main(["reader", "--frames", "10", "--json"]) == 1


@pytest.mark.usefixtures("reader")
def test_impossible_option_exits_with_2_and_says_why(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        bench.main(["reader", "--frames", "1"])
    assert capsys.readouterr().err.endswith("bench.py reader: error: --frames must be at least 2\n")


def test_unknown_bench_exits_with_2_and_lists_the_names(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="2"):
        bench.main(["screen"])
    assert "invalid choice: 'screen' (choose from 'live', 'reader'" in capsys.readouterr().err
    with pytest.raises(SystemExit, match="0"):
        bench.main(["--help"])
    said = capsys.readouterr().out
    assert all(about in said for about in bench.BENCHES.values())


def test_a_table_shows_each_figure_and_each_part_by_its_name() -> None:
    out = io.StringIO()
    bench.show({"wrong": 0, "clean": {"actions": 7}, "trials": [{"seed": 5}, {"seed": 6}]}, Console(file=out, width=60))
    words = out.getvalue().split()
    assert [word for word in words if word.isalnum()] == [
        *("wrong", "0", "clean", "actions", "7", "trials", "1", "seed", "5", "trials", "2", "seed", "6"),
    ]
