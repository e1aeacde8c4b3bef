"""``mc-nested train --builders``: its files, a resume after a stop, and its refusals."""

import json
import signal
from pathlib import Path

import pytest

from mc_nested.learn.runs.checkpoint import unsealed
from mc_nested.learn.trainer import Trainer
from tests.cli.running import check_mistake, run, table

TRAIN = ["train", "--builders", "3", "--episodes", "40", "--trials", "2", "--seed", "3"]


@pytest.fixture(scope="module")
def team_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "team"
    assert run(*TRAIN, "--out", out) == 0
    return out


def files_of(path: Path) -> dict[str, bytes]:
    """Return everything but what names the time or the order of saves."""
    names = ("config.toml", "episodes.csv", "evaluations.csv", "curve.png", "team.png", "checkpoint/state.npz")
    return {name: (path / name).read_bytes() for name in names}


def test_team_training_writes_its_tables_summary_and_pictures(team_run: Path) -> None:
    summary = json.loads((team_run / "summary.json").read_text())
    assert (summary["builders"], summary["networks_kind"], summary["networks"]) == (3, "shared", 2)
    assert summary["starts"] == [[7, 14], [12, 14], [2, 14]]
    assert summary["episodes_done"] == [40, 40]
    assert summary["env_steps"] == sum(int(row["steps"]) for row in table(team_run / "episodes.csv"))
    last = [row["score"] for row in table(team_run / "evaluations.csv") if row["episode"] == "40"]
    assert summary["final_scores"] == [float(score) for score in last]
    assert (team_run / "team.png").read_bytes().startswith(b"\x89PNG")
    assert (team_run / "curve.png").read_bytes().startswith(b"\x89PNG")


def test_the_same_seed_gives_the_same_files(team_run: Path, tmp_path: Path) -> None:
    assert run(*TRAIN, "--out", tmp_path / "again") == 0
    assert files_of(tmp_path / "again") == files_of(team_run)


@pytest.mark.parametrize("networks", ["own", "single"])
def test_ctrl_c_saves_and_resume_goes_on_to_the_same_files(
    networks: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*TRAIN, "--networks", networks, "--out"]
    assert run(*words, tmp_path / "whole") == 0
    tick = Trainer.tick

    def tick_and_interrupt(trainer: Trainer) -> None:
        tick(trainer)
        if trainer.ticks == 400:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Trainer, "tick", tick_and_interrupt)
    capsys.readouterr()
    stopped = tmp_path / "stopped"
    assert run(*words, stopped) == 130
    assert f"stopped and saved: go on with mc-nested train --resume {stopped}" in capsys.readouterr().err
    monkeypatch.undo()
    assert run("train", "--resume", stopped) == 0
    assert files_of(stopped) == files_of(tmp_path / "whole")


def test_a_training_killed_before_its_first_checkpoint_begins_again(team_run: Path, tmp_path: Path) -> None:
    begun = tmp_path / "begun"
    begun.mkdir()
    (begun / "config.toml").write_bytes((team_run / "config.toml").read_bytes())
    assert run("train", "--resume", begun) == 0
    assert files_of(begun) == files_of(team_run)


def test_json_has_the_summary_and_the_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "run"
    assert run("train", "--episodes", "5", "--start", "7,14", "--start", "0,0", "--json", "--out", out) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["folder"] == str(out)
    assert said["starts"] == [[7, 14], [0, 0]]
    summary = unsealed(out / "summary.json")
    assert said == {"folder": str(out), **summary, "live": None}


def test_a_team_training_is_listed_among_the_runs(team_run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "list", team_run.parent, "--json") == 0
    (found,) = json.loads(capsys.readouterr().out)["runs"]
    assert (found["verb"], found["state"], found["agents"]) == ("train", "finished", ["3 shared"])
    assert (found["episodes_done"], found["episodes"], found["optimum"]) == (80, 80, 21.0)


def test_team_training_that_only_began_can_be_resumed_and_a_damaged_one_is_listed_as_damaged(
    team_run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    begun = tmp_path / "begun"
    begun.mkdir()
    (begun / "config.toml").write_bytes((team_run / "config.toml").read_bytes())
    assert run("runs", "list", begun, "--json") == 0
    assert json.loads(capsys.readouterr().out)["runs"][0]["state"] == "can be resumed"
    (begun / "checkpoint").mkdir()
    (begun / "checkpoint" / "state.npz").write_bytes((team_run / "checkpoint" / "state.npz").read_bytes()[:1000])
    assert run("runs", "list", begun, "--json") == 0
    assert json.loads(capsys.readouterr().out)["runs"][0]["state"] == "damaged"


def test_evaluate_scores_every_team_trial_and_play_is_refused_with_that_command(
    team_run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    summary = json.loads((team_run / "summary.json").read_text())
    assert run("runs", "evaluate", team_run, "--json") == 0
    assert json.loads(capsys.readouterr().out)["scores"] == summary["final_scores"]
    assert run("play", team_run) == 2
    assert f"mc-nested runs evaluate {team_run}" in capsys.readouterr().err


def test_training_from_a_team_run_has_its_policy_and_from_a_single_builders_run_is_refused(
    team_run: Path, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    more = ("train", "--from", team_run, "--builders", "3", "--episodes", "1", "--out", tmp_path / "more")
    assert run(*more) == 0
    best = max(json.loads((team_run / "summary.json").read_text())["final_scores"])
    assert float(table(tmp_path / "more" / "evaluations.csv")[0]["score"]) == best
    capsys.readouterr()
    assert run("train", "--from", trained, "--builders", "3", "--out", tmp_path / "other") == 2
    assert "its networks don't fit this training: take --agent nested, " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--builders", "5"], "5 builders: an arena takes 1 to 4"),
        (["--builders", "0"], "0 builders: an arena takes 1 to 4"),
        (["--start", "7,14", "--start", "7,14"], "builders 0 and 1 both start on cell (7, 14): give each a cell"),
        (["--start", "7,14", "--start", "7,15"], "builder 1 starts on (7, 15), outside: choose 0 to 14 for x and y"),
        (["--start", "7"], "--start '7' is no cell: name it as X,Y, like 7,14"),
        (["--start", "7,a"], "--start '7,a' is no cell: name it as X,Y, like 7,14"),
        (["--builders", "3", "--start", "7,14"], "--builders 3 and 1 times --start: give each builder one start"),
        (["--networks", "many"], "no networks 'many': choose one of shared, own, single"),
        (["--preset", "tuned"], "a preset with [excursions] is for one agent alone: take paper, or one with"),
        (["--preset", "model-based"], "a preset with [imagination] is for one agent alone"),
        (["--preset", "image"], "several builders see numbers, not states 'image'"),
        (["--scenario", "castle"], "castle"),
        (["--agent", "single"], "--agent doesn't go with --builders, --start and --networks: leave it out"),
        (["--backend", "virtual"], "--backend doesn't go with --builders, --start and --networks: leave it out"),
        (
            ["--resume", "NEW", "--builders", "2"],
            "--resume goes on with the run's own config.toml: leave out --builders",
        ),
    ],
)
def test_mistake_is_refused_in_one_line_with_exit_code_2(
    words: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = [] if "--resume" in words else ["--out", "NEW"]
    several = [] if {"--builders", "--start", "--networks"} & set(words) else ["--builders", "2"]
    check_mistake(["train", *several, *words, *out], says, trained, tmp_path, capsys)


def test_config_with_two_builders_on_one_start_is_refused(
    team_run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other, config = tmp_path / "other", (team_run / "config.toml").read_text()
    other.mkdir()
    (other / "config.toml").write_text(config.replace("[[7, 14], [12, 14], [2, 14]]", "[[7, 14], [7, 14]]"))
    assert run("train", "--resume", other) == 2
    assert "builders 0 and 1 both start on cell (7, 14): give each a cell of its own" in capsys.readouterr().err
