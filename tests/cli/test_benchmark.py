"""``mc-nested benchmark``, tiny: its files, that they are the same however it went, and what it refuses."""

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from mc_nested.cli import benchmark as benchmark_module
from mc_nested.cli.benchmark import benchmark_of
from mc_nested.cli.json_fields import JSON_FIELDS
from mc_nested.learn.experiments.job_training import Evaluated, JobOutcome, RunOutcome
from mc_nested.learn.runs.folder_lock import folder_lock
from tests.cli.running import run, table
from tests.learn.experiments.test_benchmark import config
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
    """The files that it ends with, the report without its line of seconds."""
    found = {name: (folder / name).read_bytes() for name in WRITTEN}
    return {**found, "benchmark.md": re.sub(rb"(?m)^Seconds.*$", b"", found["benchmark.md"])}


@pytest.mark.slow
def test_it_leaves_the_same_files_for_any_number_of_processes_and_after_a_resume(
    files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words: list[str | Path] = ["benchmark", "--corpus", files / "mine.toml", "--trials", "2", "--agents"]
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
    assert run("benchmark", "--resume", files / "1") == 0
    assert written(files / "1") == found[0]
    capsys.readouterr()
    assert run("benchmark", "--resume", files / "1", "--json") == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed.keys() == JSON_FIELDS["benchmark"].keys()
    assert printed["files"]["report"] == str(files / "1" / "benchmark.md")
    solved = {each["contestant"]: (each["trials"], each["solved"]) for each in printed["measures"]}
    assert solved.keys() == {"nested, tiny", "nested, small", "single, tiny", "single, small"}
    assert {trials for trials, _ in solved.values()} == {4}
    with folder_lock(files / "1"):
        assert run("benchmark", "--resume", files / "1") == 2
    assert f"{files / '1'}: process " in capsys.readouterr().err
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
        (["--out", "NEW", "--agents", "sb3"], "stable-baselines3 isn't installed: pip install"),
        (["--out", "NEW", "--agents", "single", "--presets", "tuned"], "single can't take tuned: [excursions]"),
        (["--out", "NEW", "--presets", "fast"], "no preset 'fast'"),
        (["--resume", "NEW", "--designs", "3"], "--resume goes on with its own config.toml: leave out --designs"),
        (["--resume", "NEW"], "no config.toml there: name the folder of a benchmark (its --out)"),
    ],
)
def test_a_mistake_is_one_line_and_nothing_is_written(
    words: list[str],
    says: str,
    files: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(benchmark_module, "is_installed", lambda: False)
    monkeypatch.chdir(files)
    assert run("benchmark", *(word.replace("NEW", str(files / "new")) for word in words)) == 2
    printed = capsys.readouterr()
    lines = printed.err.splitlines()
    assert says in lines[-1]
    assert all(line.startswith("sb3 is left out") for line in lines[:-1])
    assert not (files / "new").exists()


def test_sb3_takes_no_preset(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(benchmark_module, "is_installed", lambda: True)
    assert run("benchmark", "--agents", "sb3", "--presets", "tuned", "--out", tmp_path / "new") == 2
    assert "sb3 takes no preset: leave out --presets" in capsys.readouterr().err


@pytest.mark.parametrize(("installed", "agents"), [(True, ["nested", "sb3"]), (False, ["nested"])])
def test_by_default_sb3_takes_part_where_it_is_installed(
    installed: bool,
    agents: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    begun: list[Any] = []
    monkeypatch.setattr(benchmark_module, "is_installed", lambda: installed)
    monkeypatch.setattr(benchmark_module, "_run", lambda folder, *_: begun.append(folder))
    assert run("benchmark", "--designs", "6", "--seed", "2", "--out", tmp_path / "new") == 0
    (folder,) = begun
    assert list(dict.fromkeys(each.agent for each in folder.config.contestants)) == agents
    assert [each.preset_name for each in folder.config.contestants][:3] == ["live", "tuned", "paper"]
    assert [design.name for design in folder.config.designs][:3] == ["edge-000", "corner-001", "scattered-002"]
    assert (folder.config.trials, folder.config.seed, folder.config.corpus) == (1, 2, None)
    assert ("sb3 is left out, since stable-baselines3 isn't installed" in capsys.readouterr().err) is not installed


def test_rows_come_in_one_order_with_all_episodes_counted() -> None:
    made = config()
    evaluations = [
        Evaluated(episode=episode, score=score, material="stone", steps=3) for episode, score in ((5, 2.0), (10, 11.0))
    ]
    own = RunOutcome(evaluations=evaluations, score=11.0, updates=9, env_steps=9)
    outcomes = [
        (job, JobOutcome(identity="", networks=1, parameters=1, seconds=4.0, runs=[own] * len(job.trials)))
        for job in reversed(made.cut())
    ]
    found = benchmark_of(made, outcomes)
    assert [(row.preset, row.design, row.trial) for row in found.rows] == [
        (preset, design, trial) for preset in ("small", "dqn") for design in ("dot", "bar") for trial in (0, 1)
    ]
    # The dot's optimum is 11, the bar's 13.
    assert [row.played_to_optimum for row in found.rows] == [12, 12, None, None] * 2
    assert found.seconds == {"nested, small": [2.0] * 4, "sb3, dqn": [4.0] * 4}
    assert found.most_episodes == {"nested, small": 20, "sb3, dqn": 500}
    assert [row.kind for row in found.rows] == ["edge"] * 8
