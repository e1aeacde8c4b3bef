"""Runs the command in this process, and checks a mistake in its words."""

import csv
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.cli.app import main
from mc_nested.learn.runs.folder_lock import folder_lock
from tests.learn.made_experiments import scenario_text, small_preset_text

TRAIN = ["train", "--episodes", "40", "--trials", "2", "--seed", "3"]


def run(*arguments: str | Path) -> int:
    with pytest.raises(SystemExit) as caught:
        main([str(argument) for argument in arguments])
    code = caught.value.code
    return code if isinstance(code, int) else 0


def table(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def write_study(folder: Path, *scenarios: Scenario) -> list[str]:
    """Write these designs and a small preset into the folder; return the words that name them, and two trials."""
    words = []
    for scenario in scenarios:
        file = folder / f"{scenario.name}.toml"
        file.write_text(scenario_text(scenario), "utf-8")
        words += ["--scenario", str(file)]
    (folder / "small.toml").write_text(small_preset_text(), "utf-8")
    return [*words, "--preset", str(folder / "small.toml"), "--trials", "2"]


def files_in(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def check_mistake(
    arguments: list[str], says: str, done: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Check that these words are refused in one line, and nothing is written.

    In them, NEW stands for a path in ``tmp_path``, where nothing is yet, and DONE for a run's folder.
    """
    new = tmp_path / "new"
    words = [word.replace("DONE", str(done)).replace("NEW", str(new)) for word in arguments]
    before = files_in(done)
    assert run(*words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("mc-nested: ")
    assert printed.err.count("\n") == 1
    assert says.replace("NEW", str(new)) in printed.err
    assert list(tmp_path.iterdir()) == []
    assert files_in(done) == before


def check_one_at_a_time(verb: list[str], folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Check that the verb goes on with no folder that another process is writing."""
    with folder_lock(folder):
        assert run(*verb, "--resume", folder) == 2
    says = f"mc-nested: {folder}: process {os.getpid()} is writing there: wait until it ends, or stop it\n"
    assert capsys.readouterr().err == says


def verbs_of(command: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Return every verb's words, and its command."""
    yield name, command
    for verb, inner in getattr(command, "commands", {}).items():
        yield from verbs_of(inner, f"{name} {verb}".strip())
