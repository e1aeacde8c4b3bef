"""``mc-nested sweep --ablation``: its folder, its files, and what it refuses."""

import csv
import json
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import table_of
from mc_nested.cli.ablation import ablation_of, is_ablation
from mc_nested.cli.app import main
from mc_nested.errors import RunError
from mc_nested.learn.experiments.ablation import AblationConfig, shipped_parts
from mc_nested.learn.experiments.experiment_folder import ExperimentFolder
from mc_nested.learn.experiments.job_training import Evaluated, JobOutcome, RunOutcome
from mc_nested.learn.experiments.jobs import Job
from mc_nested.learn.runs.folder_lock import folder_lock
from tests.learn.made_experiments import BAR, DOT, scenario_text


def run(*arguments: str | Path) -> int:
    with pytest.raises(SystemExit) as caught:
        main([str(argument) for argument in arguments])
    code = caught.value.code
    return code if isinstance(code, int) else 0


def config(*names: str) -> AblationConfig:
    """The named parts on two designs, two trials of 20 episodes."""
    parts = [part for part in shipped_parts(20) if part.name in names]
    return AblationConfig(trials=2, seed=0, jobs=1, scenarios=[table_of(DOT), table_of(BAR)], parts=parts)


def outcome(job: Job) -> JobOutcome:
    """At the optimum in the second greedy episode, after 3 others, but for trial 1, which never is."""
    runs = []
    for scenario, trial in zip(job.scenarios, job.trials, strict=True):
        scores = [0.0, 1.0 if trial else scenario.optimum]
        rows = [Evaluated(episode=3 * at, score=score, material="stone", steps=4) for at, score in enumerate(scores)]
        runs.append(RunOutcome(evaluations=rows, score=max(scores), updates=50 + trial, env_steps=9))
    return JobOutcome(identity="", networks=2, parameters=9, seconds=1.0, runs=runs)


def test_a_row_counts_the_greedy_episodes_too_and_is_empty_where_it_was_never_at_the_optimum() -> None:
    made = config("live as it is", "tuned as it is")
    found = ablation_of(made, [(job, outcome(job)) for job in made.cut()])
    assert [(row.part, row.base, row.scenario, row.trial) for row in found.rows] == [
        (f"{base} as it is", base, scenario, trial)
        for base in ("live", "tuned")
        for scenario in ("dot", "bar")
        for trial in (0, 1)
    ]
    assert [row.played_to_optimum for row in found.rows[:2]] == [3 + 2, None]
    assert [row.updates for row in found.rows[:2]] == [50, 51]
    assert [part.most_episodes for part in found.parts] == [20, 20]


def test_a_folder_says_whether_it_is_an_ablation_s(tmp_path: Path) -> None:
    ExperimentFolder.new(tmp_path / "one", config("live as it is"), "sweep").begin()
    assert is_ablation(tmp_path / "one")
    assert not is_ablation(tmp_path / "none")
    (tmp_path / "config.toml").write_text("variants = []\n", "utf-8")
    assert not is_ablation(tmp_path)
    (tmp_path / "config.toml").write_text("variants = [\n", "utf-8")
    with pytest.raises(RunError, match="not TOML"):
        is_ablation(tmp_path)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--out", "new", "--preset", "tuned"], "--ablation takes parts off the presets live and tuned"),
        (["--resume", "old"], "leave out --ablation"),
        (["--out", "new", "--scenario", "line", "--scenario", "line"], "two scenarios are named 'line'"),
    ],
)
def test_what_can_not_be_is_one_line(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("sweep", "--ablation", *words) == 2
    error = capsys.readouterr().err.strip()
    assert says in error
    assert "\n" not in error


def test_an_ablation_goes_on_by_sweep_resume_and_leaves_its_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    planner = "planner on the learnt map, no network"
    ExperimentFolder.new(out, config(planner, "tuned, γ 0"), "sweep").begin()
    assert run("sweep", "--resume", out) == 0
    with (out / "ablation.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["part"], row["scenario"], row["trial"]) for row in rows] == [
        (part, scenario, trial) for part in ("tuned, γ 0", planner) for scenario in ("dot", "bar") for trial in "01"
    ]
    assert {row["updates"] for row in rows if row["part"] == planner} == {"0"}
    written = {name: (out / name).read_bytes() for name in ("ablation.csv", "ablation.md", "ablation.png")}
    capsys.readouterr()
    assert run("sweep", "--resume", out, "--json") == 0
    assert json.loads(capsys.readouterr().out)["files"]["table"] == str(out / "ablation.md")
    assert {name: (out / name).read_bytes() for name in written} == written
    with folder_lock(out):
        assert run("sweep", "--resume", out) == 2
    assert f"{out}: process " in capsys.readouterr().err


@pytest.mark.slow
def test_an_ablation_has_a_row_for_each_trial_of_each_part(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(scenario_text(DOT), "utf-8")
    words: list[str | Path] = ["sweep", "--ablation", "--scenario", tmp_path / "dot.toml", "--trials", "2"]
    out = tmp_path / "out"
    assert run(*words, "--episodes", "3", "--out", out) == 0
    with (out / "ablation.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [(row["part"], row["trial"]) for row in rows] == [
        (part.name, trial) for part in shipped_parts() for trial in "01"
    ]
