"""``mc-nested train``: its files, a start from another run, a resume, and its refusals."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from importlib import resources
from pathlib import Path

import cv2
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import DesktopError, LiveError, McNestedError
from mc_nested.learn.runs.checkpoint import FILE, unsealed
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from scripts.benches.person import clumsy
from scripts.benches.teach import record_a_build
from sim.grid import GridVectorEnv
from tests.cli.fragile_game import open_live
from tests.cli.made_imagination import SMALL, write_preset, write_scenario
from tests.cli.running import TRAIN, check_one_at_a_time, run, table
from tests.full_disk import full_disk


def test_training_writes_config_tables_curve_checkpoint_and_summary(trained: Path) -> None:
    found = {path.name for path in trained.iterdir()}
    left = {"config.toml", "episodes.csv", "evaluations.csv", "curve.png", "checkpoint", "summary.json", "tensorboard"}
    assert found == {*left, "view"}
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


def test_preset_model_based_reaches_the_optimum_on_the_line_in_at_most_40_episodes(optimal: Path) -> None:
    summary = json.loads((optimal / "summary.json").read_text())
    assert summary["final_scores"] == [21.0, 21.0]
    rows = [row for name in ("episodes", "evaluations") for row in table(optimal / f"{name}.csv")]
    for trial in range(2):
        played = [int(row["steps"]) for row in rows if row["trial"] == str(trial)]
        assert len(played) <= 40
        assert summary["played_to_optimum"][trial] == {"episodes": len(played), "steps": sum(played)}


def test_map_of_the_learnt_arena_is_drawn_beside_the_curve(optimal: Path) -> None:
    found = {path.name: cv2.imread(str(path)) for path in optimal.glob("*.png")}
    assert {name: picture.shape[:2] for name, picture in found.items() if picture is not None} == {
        "curve.png": (840, 960),
        "map.png": (744, 1440),
    }


def test_stopped_training_with_imagination_resumes_to_the_same_files(tmp_path: Path) -> None:
    preset, design = write_preset(tmp_path / "preset.toml"), write_scenario(tmp_path / "small.toml", SMALL)
    words = ("train", "--preset", preset, "--scenario", design, "--episodes", "6")
    assert run(*words, "--out", tmp_path / "whole") == 0
    whole = RunFolder.open(tmp_path / "whole")
    stopped = RunFolder.new(tmp_path / "stopped", whole.config)
    stopped.begin()
    trainer = Trainer(
        GridVectorEnv(stopped.scenarios), stopped.scenarios, stopped.new_agent(1), stopped.config.preset, 0
    )
    while len(trainer.episode_rows) < 3:
        trainer.tick()
    trainer.tick()
    stopped.save(trainer, 0.0)
    assert run("train", "--resume", tmp_path / "stopped") == 0
    for name in ("episodes.csv", "evaluations.csv", "map.png", "curve.png", f"checkpoint/{FILE}"):
        assert (tmp_path / "stopped" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name


def test_a_training_that_stops_at_the_optimum_says_after_how_many_episodes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    small = write_scenario(tmp_path / "small.toml", SMALL)
    words: list[str | Path] = ["train", "--preset", "model-based", "--scenario", small, "--stop-at-optimum"]
    assert run(*words, "--out", tmp_path / "run") == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))
    (trained,), (played,) = summary["episodes_to_optimum"], summary["played_to_optimum"]
    assert played["episodes"] > trained
    printed = capsys.readouterr().out
    assert f"episodes to the optimum: {trained}; with the greedy ones: {played['episodes']}\n" in printed


@pytest.mark.parametrize(
    ("more", "says"),
    [((), "expected: about 0 minutes of game time, 3 episodes"), (("--stop-at-optimum",), "expected: at most about 0")],
)
def test_live_training_says_first_how_long_it_should_take(
    more: tuple[str, ...],
    says: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    open_live(monkeypatch, float("inf"))
    live = ("train", "--backend", "live", "--profile", "mine", "--episodes", "2", *more)
    small = write_scenario(tmp_path / "small.toml", SMALL)
    assert run(*live, "--scenario", small, "--out", tmp_path / "run") == 0
    assert capsys.readouterr().out.splitlines()[0].startswith(says)
    assert run("train", "--resume", tmp_path / "run") == 0
    assert "expected:" not in capsys.readouterr().out


def test_networks_that_diverge_end_the_training_in_one_line_and_are_not_saved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    preset = tmp_path / "wild.toml"
    paper = (resources.files("mc_nested.learn") / "presets/paper.toml").read_text("utf-8")
    preset.write_text(paper.replace("learning_rate = 1e-3", "learning_rate = 1e38"))
    capsys.readouterr()
    assert run("train", "--preset", preset, "--episodes", "30", "--out", tmp_path / "new") == 2
    said = capsys.readouterr().err
    assert said.startswith("mc-nested: learning_rate 1e+38 is too high")
    assert said.count("\n") == 1
    assert {path.name for path in (tmp_path / "new").iterdir()} <= {"config.toml", "tensorboard", "view"}


def test_training_from_another_has_its_policy_before_the_first_episode(optimal: Path, tmp_path: Path) -> None:
    live = ("train", "--preset", "model-based", "--episodes", "6", "--trials", "2", "--seed", "9")
    assert run(*live, "--from", optimal, "--out", tmp_path / "on") == 0
    summary = json.loads((tmp_path / "on" / "summary.json").read_text())
    assert summary["episodes_to_optimum"] == [0, 0]
    assert summary["final_scores"] == [21.0, 21.0]
    assert summary["played_to_optimum"] == [{"episodes": 1, "steps": rows} for rows in _first_steps(tmp_path / "on")]


def _first_steps(folder: Path) -> list[int]:
    rows = [row for row in table(folder / "evaluations.csv") if row["episode"] == "0"]
    return [int(row["steps"]) for row in sorted(rows, key=lambda row: row["trial"])]


@pytest.mark.parametrize("other", [("--preset", "paper"), ("--agent", "hierarchical"), ("--scenario", "small.toml")])
def test_training_from_a_run_with_other_networks_is_refused(
    optimal: Path,
    tmp_path: Path,
    other: tuple[str, str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    write_scenario(Path("small.toml"), SMALL)  # five cells a side, so that there are fewer inputs
    base = [] if other[0] == "--preset" else ["--preset", "model-based"]
    assert run("train", *base, *other, "--from", optimal, "--out", tmp_path / "new") == 2
    assert "its networks don't fit this training: take --agent nested, " in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_training_from_another_can_begin_again_after_a_full_disk(
    optimal: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("train", "--preset", "model-based", "--episodes", "6", "--from", optimal, "--out", tmp_path / "new")
    with monkeypatch.context() as patch:
        patch.setattr("os.fsync", full_disk)
        assert run(*words) == 2
    assert "make room and begin again" in capsys.readouterr().err
    assert run(*words) == 0
    assert json.loads((tmp_path / "new" / "summary.json").read_text())["episodes_to_optimum"] == [0]


def test_the_same_seed_gives_the_same_files(trained: Path, tmp_path: Path) -> None:
    assert run(*TRAIN, "--out", tmp_path / "again") == 0
    for name in ("episodes.csv", "evaluations.csv", "config.toml", "curve.png"):
        assert (tmp_path / "again" / name).read_bytes() == (trained / name).read_bytes(), name
    one, other = (unsealed(folder / "summary.json") for folder in (trained, tmp_path / "again"))
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
        time.sleep(0.005)  # a core that only waits is missing elsewhere
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said.splitlines()[-1] == f"mc-nested: stopped and saved: go on with mc-nested train --resume {out}"
    assert len(table(out / "episodes.csv")) < 80
    assert json.loads((out / "summary.json").read_text())["final_scores"] == [None, None]
    assert run("train", "--resume", out) == 0
    for name in ("episodes.csv", "evaluations.csv", f"checkpoint/{FILE}"):
        assert (out / name).read_bytes() == (trained / name).read_bytes(), name


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for another process")
def test_ctrl_c_saves_even_if_it_also_ends_the_reader_of_the_pipe(tmp_path: Path) -> None:
    reads, writes = os.pipe()
    command = [sys.executable, "-m", "mc_nested.cli", *TRAIN, "--out", str(tmp_path / "run")]
    # With it Python keeps nothing back that it would have to write when it ends.
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    process = subprocess.Popen(command, stdout=writes, stderr=writes, env=buffered)
    os.close(writes)
    deadline = time.monotonic() + 60
    while not (tmp_path / "run" / "config.toml").exists() and time.monotonic() < deadline:
        time.sleep(0.005)  # a core that only waits is missing elsewhere
    os.close(reads)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=60) == 130
    assert (tmp_path / "run" / "summary.json").exists()
    assert run("train", "--resume", tmp_path / "run") == 0


def test_a_run_is_resumed_by_one_process_at_a_time(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.copytree(trained, tmp_path / "run")
    check_one_at_a_time(["train"], tmp_path / "run", capsys)
    assert run("train", "--resume", tmp_path / "run") == 0


def test_folder_without_a_name_is_printed_at_the_beginning_and_at_the_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("train", "--episodes", "2", "--scenario", "zigzag", "--agent", "single") == 0
    (folder,) = Path("runs").iterdir()
    assert re.fullmatch(r"zigzag-single-\d{4}-\d\d-\d\d-\d{6}", folder.name)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"run:        {folder}"
    assert lines.count(f"run:        {folder}") == 2
    assert lines[-2].startswith("below the optimum; for more: mc-nested train --from ")
    assert lines[-1].startswith(f"next:       mc-nested play {folder} shows what it builds")


def test_json_has_the_summary_and_the_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*TRAIN, "--json", "--quiet", "--out", tmp_path / "run") == 0
    printed = capsys.readouterr()
    summary = unsealed(tmp_path / "run" / "summary.json")
    of_others = dict.fromkeys(("live", "builders", "networks_kind", "starts"))
    assert json.loads(printed.out) == {"folder": str(tmp_path / "run"), **summary, **of_others}
    assert printed.err == ""


def test_quiet_prints_the_result_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*TRAIN, "-q", "--out", tmp_path / "run") == 0
    printed = capsys.readouterr()
    assert [line.split(":")[0] for line in printed.out.splitlines()] == [
        "final scores (optimum 21)",
        "run",
        "curve",
        "checkpoint",
    ]
    assert printed.err == ""


def test_a_training_killed_before_its_first_checkpoint_begins_again(trained: Path, tmp_path: Path) -> None:
    (tmp_path / "config.toml").write_bytes((trained / "config.toml").read_bytes())
    assert run("train", "--resume", tmp_path) == 0
    assert (tmp_path / "episodes.csv").read_bytes() == (trained / "episodes.csv").read_bytes()


def test_resume_with_a_lost_checkpoint_is_refused_and_keeps_the_tables(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("config.toml", "episodes.csv"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    assert run("train", "--resume", tmp_path) == 2
    assert "the checkpoint is gone" in capsys.readouterr().err
    assert (tmp_path / "episodes.csv").read_bytes() == (trained / "episodes.csv").read_bytes()


def test_full_disk_is_a_one_line_error_and_costs_no_file(
    trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "run"
    shutil.copytree(trained, out)
    monkeypatch.setattr("mc_nested.cli.training_end.draw_curve", full_disk)
    assert run("train", "--resume", out) == 2
    said = capsys.readouterr().err
    assert "no space left on the disk" in said
    assert f"make room, then mc-nested train --resume {out}" in said.splitlines()[-1]
    assert said.count("mc-nested: ") == 1
    assert {path.name for path in out.iterdir()} == {path.name for path in trained.iterdir()}
    assert (out / "curve.png").read_bytes() == (trained / "curve.png").read_bytes()


@pytest.mark.slow
def test_training_into_an_ascii_pipe_succeeds(tmp_path: Path) -> None:
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


def test_a_truncated_checkpoint_is_refused(trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    broken = tmp_path / "broken"
    (broken / "checkpoint").mkdir(parents=True)
    (broken / "config.toml").write_bytes((trained / "config.toml").read_bytes())
    whole = (trained / "checkpoint" / FILE).read_bytes()
    (broken / "checkpoint" / FILE).write_bytes(whole[: len(whole) // 2])
    assert run("train", "--resume", broken) == 2
    assert "damaged or cut short" in capsys.readouterr().err
    assert (broken / "checkpoint" / FILE).read_bytes() == whole[: len(whole) // 2]


@pytest.mark.parametrize("error", [LiveError("it lagged"), DesktopError("the window has closed")])
def test_training_whose_game_fails_is_saved_and_can_be_resumed(
    error: McNestedError, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 30, error)
    live = ("--backend", "live", "--profile", "mine", "--episodes", "2")
    assert run("train", *live, "--out", tmp_path / "run") == 2
    told = capsys.readouterr().err.splitlines()
    assert told[-1] == f"mc-nested: {error}; saved: go on with mc-nested train --resume {tmp_path / 'run'}"
    open_live(monkeypatch, float("inf"))
    assert run("train", "--resume", tmp_path / "run") == 0


def test_training_repeats_an_episode_that_a_mishap_spoiled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    open_live(monkeypatch, 30, LiveError("it lagged"), failures=3)
    live = ("--backend", "live", "--profile", "mine", "--episodes", "3")
    assert run("train", *live, "--out", tmp_path / "run") == 0
    rows = (tmp_path / "run" / "episodes.csv").read_text(encoding="utf-8").splitlines()
    assert [row.split(",")[1] for row in rows[1:]] == ["1", "2", "3"]


def test_a_training_learns_from_a_recording_of_a_persons_build_first(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = load_scenario("line")
    record_a_build(tmp_path / "shown", line, clumsy(line, 0, 0.2, 0), 0)
    words = ["train", "--scenario", "line", "--episodes", "2", "--from-recording", str(tmp_path / "shown")]
    assert run(*words, "--out", tmp_path / "run", "--json") == 0
    told = capsys.readouterr()
    assert "1 whole episode to learn from" in told.err
    result = json.loads(told.out)
    assert (result["demonstrated"], result["episodes_done"]) == ([1], [2])
    assert run("train", "--resume", tmp_path / "run", "--from-recording", tmp_path / "shown") == 2
    assert "--from-recording" in capsys.readouterr().err


def test_a_folder_that_is_no_recording_is_refused_as_a_demonstration(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "--scenario", "line", "--from-recording", tmp_path) == 2
    said = capsys.readouterr().err
    assert (said.count("\n"), "recording" in said) == (1, True)
