"""``mc-nested study benchmark`` with tiny sizes: its files, the same for any processes, and its refusals."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from mc_nested.cli import study as study_module
from mc_nested.cli.output import json_fields
from mc_nested.studies import benchmark
from tests.cli.running import check_one_at_a_time, run, table
from tests.learn.made_experiments import small_preset_text

WRITTEN = ("benchmark.csv", "benchmark.md", "benchmark.png")

CORPUS = """
[[designs]]
name = "dot"
design = "#"

[[designs]]
name = "pair"
design = '''
#.
.#
'''
"""


@pytest.fixture
def files(tmp_path: Path) -> Path:
    (tmp_path / "mine.toml").write_text(CORPUS, "utf-8")
    (tmp_path / "small.toml").write_text(small_preset_text(), "utf-8")
    return tmp_path


def written(folder: Path) -> dict[str, bytes]:
    """Return the files that it ends with, the report without its line of seconds."""
    found = {name: (folder / name).read_bytes() for name in WRITTEN}
    return {**found, "benchmark.md": re.sub(rb"(?m)^Seconds.*$", b"", found["benchmark.md"])}


@pytest.mark.slow
def test_a_benchmark_leaves_the_same_files_for_any_number_of_processes_and_after_a_resume(
    files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words: list[str | Path] = ["study", "benchmark", "--corpus", files / "mine.toml", "--trials", "2", "--agents"]
    shutil.copy(files / "small.toml", files / "tiny.toml")
    words += ["nested,single", "--presets", f"{files / 'tiny.toml'},{files / 'small.toml'}"]
    found = []
    for jobs in ("1", "2"):
        assert run(*words, "--jobs", jobs, "--out", files / jobs) == 0
        found.append(written(files / jobs))
        assert "nested, tiny" in capsys.readouterr().out
    assert found[0] == found[1]
    for unit in list((files / "1" / "jobs").iterdir())[:3]:
        if unit.is_dir():
            shutil.rmtree(unit)
    assert run("study", "benchmark", "--resume", files / "1") == 0
    assert written(files / "1") == found[0]
    capsys.readouterr()
    assert run("study", "benchmark", "--resume", files / "1", "--json") == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed.keys() == json_fields(study_module.command_of(benchmark.STUDY)).keys()
    assert printed["files"]["report"] == str(files / "1" / "benchmark.md")
    solved = {each["contestant"]: (each["trials"], each["solved"]) for each in printed["measures"]}
    assert solved.keys() == {"nested, tiny", "nested, small", "single, tiny", "single, small"}
    assert {trials for trials, _ in solved.values()} == {4}
    check_one_at_a_time(["study", "benchmark"], files / "1", capsys)
    rows = table(files / "1" / "benchmark.csv")
    assert [(row["agent"], row["preset"]) for row in rows[::4]] == [
        ("nested", "tiny"),
        ("nested", "small"),
        ("single", "tiny"),
        ("single", "small"),
    ]
    assert [(row["design"], row["kind"], row["trial"]) for row in rows[:4]] == [
        ("dot", "edge", "0"),
        ("dot", "edge", "1"),
        ("pair", "corner", "0"),
        ("pair", "corner", "1"),
    ]
    # The same preset under two names learns the same.
    assert [row["updates"] for row in rows[:4]] == [row["updates"] for row in rows[4:8]]


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--out", "NEW", "--corpus", "none.toml"], "none.toml: can't be read"),
        (["--out", "NEW", "--corpus", "mine.toml", "--designs", "3"], "--designs is how many are drawn at random"),
        (["--out", "NEW", "--agents", "nested,dqn"], "no agent 'dqn': choose of nested, hierarchical, single, sb3"),
        (["--out", "NEW", "--agents", "sb3"], "stable-baselines3 isn't installed: install mc-nested"),
        (["--out", "NEW", "--agents", "single", "--presets", "tuned"], "single can't take tuned: [excursions]"),
        (["--out", "NEW", "--presets", "fast"], "no preset 'fast'"),
        (["--resume", "NEW", "--designs", "3"], "--resume goes on with its own config.toml: leave out --designs"),
        (["--resume", "NEW"], "no config.toml there: name a folder of mc-nested study benchmark (its --out)"),
    ],
)
def test_mistake_is_refused_in_one_line_and_nothing_is_written(
    words: list[str],
    says: str,
    files: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(benchmark, "is_installed", lambda: False)
    monkeypatch.chdir(files)
    assert run("study", "benchmark", *(word.replace("NEW", str(files / "new")) for word in words)) == 2
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    assert says in lines[-1]
    assert all(line.startswith("sb3 is left out") for line in lines[:-1])
    assert not (files / "new").exists()


def test_stable_baselines3_takes_no_preset(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(benchmark, "is_installed", lambda: True)
    assert run("study", "benchmark", "--agents", "sb3", "--presets", "tuned", "--out", tmp_path / "new") == 2
    assert "sb3 takes no preset: leave out --presets" in capsys.readouterr().err


@pytest.mark.parametrize(("installed", "agents"), [(True, ["nested", "sb3"]), (False, ["nested"])])
def test_stable_baselines3_takes_part_by_default_where_it_is_installed(
    installed: bool,
    agents: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    begun: list[Any] = []
    monkeypatch.setattr(benchmark, "is_installed", lambda: installed)
    monkeypatch.setattr(study_module, "run_study", lambda _study, folder, *_: begun.append(folder))
    assert run("study", "benchmark", "--designs", "6", "--seed", "2", "--out", tmp_path / "new") == 0
    (folder,) = begun
    assert list(dict.fromkeys(arm.agent for arm in folder.config.arms)) == agents
    assert [arm.preset_name for arm in folder.config.arms][:3] == ["model-based", "tuned", "paper"]
    assert list(folder.config.scenarios)[:3] == ["edge-000", "corner-001", "scattered-002"]
    assert (folder.config.trials, folder.config.seed, folder.config.notes) == (1, 2, {})
    assert ("sb3 is left out, since stable-baselines3 isn't installed" in capsys.readouterr().err) is not installed
