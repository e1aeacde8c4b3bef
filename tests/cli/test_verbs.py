"""The command line: what each verb prints and writes, and one line with exit code 2 for every mistake."""

import csv
import importlib.metadata
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from importlib import resources
from pathlib import Path

import pytest

from mc_nested.cli.app import main
from mc_nested.learn.runs.checkpoint import FILE

TRAIN = ["train", "--episodes", "40", "--trials", "2", "--seed", "3"]


def run(*arguments: str | Path) -> int:
    with pytest.raises(SystemExit) as caught:
        main([str(argument) for argument in arguments])
    code = caught.value.code
    return code if isinstance(code, int) else 0


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "run"
    assert run(*TRAIN, "--out", out) == 0
    return out


def table(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_a_training_leaves_everything_behind(trained: Path) -> None:
    found = {path.name for path in trained.iterdir()}
    left = {"config.toml", "episodes.csv", "evaluations.csv", "curve.png", "checkpoint", "summary.json", "tensorboard"}
    assert found == left
    assert {path.name for path in (trained / "tensorboard").iterdir()} == {"trial-0", "trial-1"}
    summary = json.loads((trained / "summary.json").read_text())
    expected = {
        "scenario": "line",
        "agent": "nested",
        "preset": "paper",
        "backend": "sim",
        "trials": 2,
        "episodes": 40,
        "optimum": 21.0,
        "networks": 2,
        "parameters": 2730,
    }
    assert {key: summary[key] for key in expected} == expected
    assert len(summary["final_scores"]) == len(summary["episodes_to_optimum"]) == 2
    assert [row["episode"] for row in table(trained / "evaluations.csv") if row["trial"] == "0"] == ["30", "40"]
    episodes = table(trained / "episodes.csv")
    assert len(episodes) == 80
    assert summary["env_steps"] == sum(int(row["steps"]) for row in episodes)


def test_evaluate_prints_the_scores_of_the_summary_in_a_fresh_process(trained: Path) -> None:
    command = [sys.executable, "-m", "mc_nested.cli", "evaluate", str(trained), "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(printed.stdout)
    assert found["scores"] == json.loads((trained / "summary.json").read_text())["final_scores"]
    assert found["optimum"] == 21.0


@pytest.fixture(scope="module")
def optimal(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A training that has reached the optimum on the line."""
    out = tmp_path_factory.mktemp("runs") / "optimal"
    assert run("train", "--preset", "live", "--stop-at-optimum", "--trials", "2", "--seed", "4", "--out", out) == 0
    return out


def test_the_preset_live_reaches_the_optimum_on_the_line_in_few_episodes(optimal: Path) -> None:
    summary = json.loads((optimal / "summary.json").read_text())
    assert summary["final_scores"] == [21.0, 21.0]
    for trial, first in enumerate(summary["episodes_to_optimum"]):
        assert first <= 200
        # Every 5 episodes a greedy one, which counts as played.
        assert summary["played_to_optimum"][trial]["episodes"] == first + first // 5
        rows = [row for name in ("episodes", "evaluations") for row in table(optimal / f"{name}.csv")]
        steps = sum(int(row["steps"]) for row in rows if row["trial"] == str(trial))
        assert summary["played_to_optimum"][trial]["steps"] == steps


def test_a_training_begun_from_another_has_its_policy_before_the_first_episode(optimal: Path, tmp_path: Path) -> None:
    live = ("train", "--preset", "live", "--episodes", "6", "--trials", "2", "--seed", "9")
    assert run(*live, "--from", optimal, "--out", tmp_path / "on") == 0
    summary = json.loads((tmp_path / "on" / "summary.json").read_text())
    assert summary["episodes_to_optimum"] == [0, 0]
    assert summary["final_scores"] == [21.0, 21.0]
    assert summary["played_to_optimum"] == [{"episodes": 1, "steps": rows} for rows in _first_steps(tmp_path / "on")]


def _first_steps(folder: Path) -> list[int]:
    rows = [row for row in table(folder / "evaluations.csv") if row["episode"] == "0"]
    return [int(row["steps"]) for row in sorted(rows, key=lambda row: row["trial"])]


@pytest.mark.parametrize("other", [("--preset", "paper"), ("--agent", "hierarchical"), ("--scenario", "diamond")])
def test_networks_that_do_not_fit_are_one_line(
    optimal: Path, tmp_path: Path, other: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    base = [] if other[0] == "--preset" else ["--preset", "live"]
    assert run("train", *base, *other, "--from", optimal, "--out", tmp_path / "new") == 2
    assert "has other networks than this" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_a_training_begun_from_another_that_can_not_be_saved_is_not_begun(
    optimal: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def full_disk(_: int) -> None:
        raise OSError(28, "No space left on device")

    words = ("train", "--preset", "live", "--episodes", "6", "--from", optimal, "--out", tmp_path / "new")
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full_disk)
        assert run(*words) == 2
    assert "make room and begin again" in capsys.readouterr().err
    assert run(*words) == 0
    assert json.loads((tmp_path / "new" / "summary.json").read_text())["episodes_to_optimum"] == [0]


def test_another_verbs_folder_is_told_by_its_verb(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for verb in ("reproduce", "sweep"):
        assert run(verb, "--resume", trained) == 2
        said = capsys.readouterr().err
        assert f"the folder of mc-nested train, not of {verb}" in said
        assert f"mc-nested train --resume {trained}" in said


def test_excursions_of_a_single_agent_are_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("train", "--preset", "tuned", "--agent", "single", "--out", tmp_path / "new") == 2
    assert "take nested or hierarchical" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_the_same_seed_gives_the_same_files(trained: Path, tmp_path: Path) -> None:
    assert run(*TRAIN, "--out", tmp_path / "again") == 0
    for name in ("episodes.csv", "evaluations.csv", "config.toml", "curve.png"):
        assert (tmp_path / "again" / name).read_bytes() == (trained / name).read_bytes(), name
    one, other = (json.loads((folder / "summary.json").read_text()) for folder in (trained, tmp_path / "again"))
    assert {**one, "wall_s": 0} == {**other, "wall_s": 0}
    assert (tmp_path / "again" / "checkpoint" / FILE).read_bytes() == (trained / "checkpoint" / FILE).read_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for another process")
def test_ctrl_c_saves_and_resume_goes_on_to_the_same_files(trained: Path, tmp_path: Path) -> None:
    out = tmp_path / "stopped"
    process = subprocess.Popen(
        [sys.executable, "-m", "mc_nested.cli", *TRAIN, "--out", str(out)], stderr=subprocess.PIPE, text=True
    )
    deadline = time.monotonic() + 60
    while not (out / "config.toml").exists() and time.monotonic() < deadline:
        os.sched_yield()
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said.strip() == f"mc-nested: stopped and saved: go on with mc-nested train --resume {out}"
    assert len(table(out / "episodes.csv")) < 80
    assert json.loads((out / "summary.json").read_text())["final_scores"] == [None, None]
    assert run("train", "--resume", out) == 0
    for name in ("episodes.csv", "evaluations.csv", f"checkpoint/{FILE}"):
        assert (out / name).read_bytes() == (trained / name).read_bytes(), name


def test_a_training_killed_before_its_first_checkpoint_begins_again(trained: Path, tmp_path: Path) -> None:
    (tmp_path / "config.toml").write_bytes((trained / "config.toml").read_bytes())
    assert run("train", "--resume", tmp_path) == 0
    assert (tmp_path / "episodes.csv").read_bytes() == (trained / "episodes.csv").read_bytes()


def test_a_lost_checkpoint_does_not_cost_the_tables(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("config.toml", "episodes.csv"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    assert run("train", "--resume", tmp_path) == 2
    assert "no checkpoint yet" in capsys.readouterr().err
    assert (tmp_path / "episodes.csv").read_bytes() == (trained / "episodes.csv").read_bytes()


def test_a_disk_that_fills_up_costs_one_line_and_not_the_last_checkpoint(
    trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "run"
    shutil.copytree(trained, out)

    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("mc_nested.cli.train.draw_curve", full)
    assert run("train", "--resume", out) == 2
    said = capsys.readouterr().err
    assert "No space left on device" in said
    assert f"make room, then mc-nested train --resume {out}" in said
    assert said.count("\n") == 1
    assert {path.name for path in out.iterdir()} == {path.name for path in trained.iterdir()}
    assert (out / "curve.png").read_bytes() == (trained / "curve.png").read_bytes()


def test_names_are_shown_as_they_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (resources.files("mc_nested.arena") / "designs" / "line.toml").read_text("utf-8")
    odd = text.replace('"line"', '"[/b] $x_{$"').replace('"wood"', '"[/w]"').replace('name = "stone"', 'name = "[/s]"')
    (tmp_path / "odd.toml").write_text(odd)
    assert run("train", "--episodes", "1", "--scenario", tmp_path / "odd.toml", "--out", tmp_path / "run") == 0
    assert run("evaluate", tmp_path / "run") == 0
    printed = capsys.readouterr().out
    assert "[/b] $x_{$, greedy" in printed
    assert "[/s]" in printed or "[/w]" in printed


def test_a_pipe_that_does_not_know_epsilon_is_no_error(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mc_nested.cli", "train", "--episodes", "1", "--out", str(tmp_path / "run")]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    subprocess.run(command, capture_output=True, check=True, env=environment)


def test_resuming_a_finished_training_changes_nothing(trained: Path) -> None:
    before = (trained / "episodes.csv").read_bytes()
    wall_s = json.loads((trained / "summary.json").read_text())["wall_s"]
    assert run("train", "--resume", trained) == 0
    assert (trained / "episodes.csv").read_bytes() == before
    assert json.loads((trained / "summary.json").read_text())["wall_s"] >= wall_s


def test_episodes_to_optimum_is_the_first_evaluation_at_the_optimum(tmp_path: Path) -> None:
    text = (resources.files("mc_nested.arena") / "designs" / "line.toml").read_text("utf-8")
    # One block, three cells in front of the start: the optimum is met early in every trial.
    grid = "\n".join(["." * 15] + ["." * 7 + "#" + "." * 7] + ["." * 15] * 13)
    head, _, tail = text.split('"""')
    dot = f'{head}"""\n{grid}\n"""{tail}'.replace("[7, 14]", "[7, 11]").replace("= 60", "= 4")
    (tmp_path / "dot.toml").write_text(dot)
    out = tmp_path / "run"
    assert run("train", "--scenario", tmp_path / "dot.toml", "--episodes", "300", "--trials", "2", "--out", out) == 0
    firsts = []
    for trial in ("0", "1"):
        rows = [row for row in table(out / "evaluations.csv") if row["trial"] == trial]
        firsts.append(next((int(row["episode"]) for row in rows if float(row["score"]) == 11.0), None))
    assert any(first is not None and first > 0 for first in firsts)
    assert json.loads((out / "summary.json").read_text())["episodes_to_optimum"] == firsts


def test_play_shows_the_arena_and_the_score(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("play", trained, "--trial", "1") == 0
    printed = capsys.readouterr().out
    score = json.loads((trained / "summary.json").read_text())["final_scores"][1]
    assert f"score {score:g} of 21" in printed
    assert "still to build" in printed


def test_play_takes_the_best_trial_by_itself(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("play", trained) == 0
    best = max(json.loads((trained / "summary.json").read_text())["final_scores"])
    assert f"score {best:g} of 21" in capsys.readouterr().out


@pytest.mark.parametrize(("agent", "networks"), [("hierarchical", 3), ("single", 1)])
def test_the_other_agents_train_evaluate_and_play(
    agent: str, networks: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / agent
    assert run(*TRAIN, "--agent", agent, "--out", out) == 0
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["agent"], summary["networks"]) == (agent, networks)
    capsys.readouterr()
    assert run("evaluate", out, "--json") == 0
    assert json.loads(capsys.readouterr().out)["scores"] == summary["final_scores"]
    assert run("play", out, "--trial", "1") == 0
    assert f"score {summary['final_scores'][1]:g} of 21" in capsys.readouterr().out


def test_scenarios_lists_the_designs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("scenarios") == 0
    printed = " ".join(capsys.readouterr().out.split())
    for words in (
        "optimum 21 fewest 13 steps",
        "optimum 21 fewest 25 steps",
        "optimum 26 fewest 38 steps; the scripted builder takes 52",
    ):
        assert words in printed


def test_a_large_design_of_a_users_own_is_listed_with_an_upper_bound(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grid = "\n".join(["...............", "###############", "...............", "###############"] + ["." * 15] * 11)
    material = '[[materials]]\nname = "glass"\np = 0\nblock = "glass"\n'
    (tmp_path / "two.toml").write_text(
        f'name = "two rows"\nstart = [0, 0]\nstep_limit = 99\ndesign = """\n{grid}\n"""\n{material}'
    )
    assert run("scenarios", tmp_path / "two.toml") == 0
    assert "an upper bound" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["train"], "name a new folder for the run with --out DIR"),
        (["train", "--out", "NEW", "--scenario", "pyramid"], "no scenario 'pyramid'"),
        (
            ["train", "--out", "NEW", "--agent", "double"],
            "no agent 'double': choose one of nested, hierarchical, single",
        ),
        (["train", "--out", "NEW", "--preset", "fast"], "no preset 'fast'"),
        (["train", "--out", "NEW", "--trials", "0"], "'--trials'"),
        (["train", "--out", "NEW", "--episodes", "0"], "'--episodes'"),
        (["train", "--out", "NEW", "--episodes", "1" + "0" * 30], "'--episodes'"),
        (["train", "--out", "NEW", "--trials", "1" + "0" * 9], "'--trials'"),
        (["train", "--out", "NEW", "--scenario", ""], "no scenario ''"),
        (["train", "--out", "NEW" + "x" * 300], "File name too long"),
        (["evaluate", "NEW" + "x" * 300], "File name too long"),
        (["train", "--out", "NEW", "--seed", "-1"], "'--seed'"),
        (["train", "--out", "NEW", "--backend", "cloud"], "'--backend'"),
        (["train", "--out", "NEW", "--backend", "live", "--trials", "2"], "one trial at a time"),
        (["train", "--out", "NEW", "--backend", "live", "--profile", "NEW.toml"], "no profile"),
        (["train", "--out", "TRAINED"], "is not empty: name a new folder, nothing was overwritten"),
        (["train", "--resume", "TRAINED", "--seed", "0"], "leave out --seed"),
        (["train", "--resume", "NEW"], "no config.toml there"),
        (["evaluate", "NEW"], "no config.toml there"),
        (["play", "TRAINED", "--trial", "2"], "has no trial 2: choose 0 to 1"),
        (["play", "TRAINED", "--backend", "live", "--profile", "NEW.toml"], "no profile"),
        (["read", "NEW.png"], "name the game's font"),
        (["read", "NEW.png", "--font", "NEW.jar"], "NEW.jar"),
        (["read", "NEW.png", "--font", "TRAINED/config.toml"], "config.toml"),
        (["frobnicate"], "No such command"),
        (["train", "--frobnicate"], "No such option"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(
    arguments: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = tmp_path / "new"
    words = [word.replace("TRAINED", str(trained)).replace("NEW", str(new)) for word in arguments]
    before = (trained / "config.toml").read_bytes()
    assert run(*words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("mc-nested: ")
    assert printed.err.count("\n") == 1
    assert says.replace("NEW", str(new)) in printed.err
    assert list(tmp_path.iterdir()) == []
    assert (trained / "config.toml").read_bytes() == before


def test_a_checkpoint_of_another_scenario_is_refused(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other"
    assert run("train", "--episodes", "1", "--scenario", "zigzag", "--out", other) == 0
    (other / "checkpoint" / FILE).write_bytes((trained / "checkpoint" / FILE).read_bytes())
    verbs: list[list[str | Path]] = [["evaluate", other], ["play", other], ["train", "--resume", other]]
    for verb in verbs:
        capsys.readouterr()
        assert run(*verb) == 2
        assert "belongs to another scenario" in capsys.readouterr().err


def test_a_truncated_checkpoint_is_refused(trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = tmp_path / "broken"
    (broken / "checkpoint").mkdir(parents=True)
    (broken / "config.toml").write_bytes((trained / "config.toml").read_bytes())
    whole = (trained / "checkpoint" / FILE).read_bytes()
    (broken / "checkpoint" / FILE).write_bytes(whole[: len(whole) // 2])
    assert run("train", "--resume", broken) == 2
    assert "damaged or cut short" in capsys.readouterr().err
    assert (broken / "checkpoint" / FILE).read_bytes() == whole[: len(whole) // 2]


def test_the_version_is_the_packages(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--version") == 0
    assert capsys.readouterr().out == f"mc-nested {importlib.metadata.version('mc-nested')}\n"


def test_nothing_but_the_verb_asks_for_help(capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    printed = capsys.readouterr().out
    for verb in ("train", "evaluate", "play", "scenarios", "read", "calibrate"):
        assert verb in printed


def test_what_draws_no_figure_loads_no_matplotlib() -> None:
    code = "import sys, mc_nested.cli.calibrate, mc_nested.cli.doctor; sys.exit('matplotlib' in sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_importing_everything_needs_no_display() -> None:
    modules = "mc_nested, mc_nested.cli, mc_nested.live.desktop, mc_nested.live.session, sim.grid, calibration"
    environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-c", f"import {modules}"], env=environment, check=True)
