"""``mc-nested cooperate``: what it leaves behind, that it goes on after a stop, and what it refuses."""

import json
import signal
from pathlib import Path

import pytest

from mc_nested.learn.cooperation.team_trainer import TeamTrainer
from tests.cli.running import check_mistake, run, table

COOPERATE = ["cooperate", "--builders", "3", "--episodes", "40", "--trials", "2", "--seed", "3"]


@pytest.fixture(scope="module")
def team_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "team"
    assert run(*COOPERATE, "--out", out) == 0
    return out


def files_of(path: Path) -> dict[str, bytes]:
    """Everything but what names the time or the order of saves."""
    names = ("config.toml", "episodes.csv", "evaluations.csv", "curve.png", "team.png", "checkpoint/state.npz")
    return {name: (path / name).read_bytes() for name in names}


def test_a_training_leaves_everything_behind(team_run: Path) -> None:
    summary = json.loads((team_run / "summary.json").read_text())
    assert (summary["builders"], summary["networks_kind"], summary["networks"]) == (3, "shared", 2)
    assert summary["starts"] == [[7, 14], [12, 14], [2, 14]]
    assert summary["episodes_done"] == [40, 40]
    assert summary["env_ticks"] == sum(int(row["steps"]) for row in table(team_run / "episodes.csv"))
    last = [row["score"] for row in table(team_run / "evaluations.csv") if row["episode"] == "40"]
    assert summary["final_scores"] == [float(score) for score in last]
    assert (team_run / "team.png").read_bytes().startswith(b"\x89PNG")
    assert (team_run / "curve.png").read_bytes().startswith(b"\x89PNG")


def test_the_same_seed_gives_the_same_files(team_run: Path, tmp_path: Path) -> None:
    assert run(*COOPERATE, "--out", tmp_path / "again") == 0
    assert files_of(tmp_path / "again") == files_of(team_run)


@pytest.mark.parametrize("networks", ["own", "single"])
def test_ctrl_c_saves_and_resume_goes_on_to_the_same_files(
    networks: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*COOPERATE, "--networks", networks, "--out"]
    assert run(*words, tmp_path / "whole") == 0
    tick = TeamTrainer.tick

    def tick_and_interrupt(trainer: TeamTrainer) -> None:
        tick(trainer)
        if trainer.ticks == 400:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(TeamTrainer, "tick", tick_and_interrupt)
    capsys.readouterr()
    stopped = tmp_path / "stopped"
    assert run(*words, stopped) == 130
    assert f"stopped and saved: go on with mc-nested cooperate --resume {stopped}" in capsys.readouterr().err
    monkeypatch.undo()
    assert run("cooperate", "--resume", stopped) == 0
    assert files_of(stopped) == files_of(tmp_path / "whole")


def test_a_training_killed_before_its_first_checkpoint_begins_again(team_run: Path, tmp_path: Path) -> None:
    begun = tmp_path / "begun"
    begun.mkdir()
    (begun / "config.toml").write_bytes((team_run / "config.toml").read_bytes())
    assert run("cooperate", "--resume", begun) == 0
    assert files_of(begun) == files_of(team_run)


def test_for_a_program_it_prints_its_summary_and_its_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "run"
    assert run("cooperate", "--episodes", "5", "--start", "7,14", "--start", "0,0", "--json", "--out", out) == 0
    said = json.loads(capsys.readouterr().out)
    assert said["folder"] == str(out)
    assert said["starts"] == [[7, 14], [0, 0]]
    assert said == {"folder": str(out), **json.loads((out / "summary.json").read_text())}


def test_it_is_among_the_runs(team_run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "list", team_run.parent, "--json") == 0
    (found,) = json.loads(capsys.readouterr().out)["runs"]
    assert (found["verb"], found["state"], found["agents"]) == ("cooperate", "finished", ["3 shared"])
    assert (found["episodes_done"], found["episodes"], found["optimum"]) == (80, 80, 21.0)


def test_one_that_only_begun_can_be_resumed_and_a_damaged_one_says_so(
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


def test_another_verbs_folder_is_refused_with_its_verb(
    team_run: Path, trained: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("runs", "evaluate", team_run) == 2
    said = capsys.readouterr().err
    assert "the folder of mc-nested cooperate, not of train" in said
    assert f"mc-nested cooperate --resume {team_run}" in said
    assert run("cooperate", "--resume", trained) == 2
    assert "the folder of mc-nested train, not of cooperate" in capsys.readouterr().err


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
        (["--preset", "tuned"], "[excursions] is for a builder alone: take the preset paper, or one with"),
        (["--preset", "live"], "[imagination] is for a builder alone"),
        (["--preset", "image"], "builders in one arena see numbers, not states 'image'"),
        (["--scenario", "castle"], "castle"),
        (["--resume", "NEW"], "NEW: no config.toml there: name the folder of a cooperation"),
        (
            ["--resume", "NEW", "--builders", "2"],
            "--resume goes on with the run's own config.toml: leave out --builders",
        ),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(
    words: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = [] if "--resume" in words else ["--out", "NEW"]
    check_mistake(["cooperate", *words, *out], says, trained, tmp_path, capsys)


def test_a_changed_config_is_refused(team_run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    other = tmp_path / "other"
    other.mkdir()
    (other / "config.toml").write_text(
        (team_run / "config.toml").read_text().replace("starts = [[7, 14], [12, 14], [2, 14]]", "starts = [[7, 14]]")
    )
    assert run("cooperate", "--resume", other) == 2
    assert "3 builders and 1 starts: give each a start" in capsys.readouterr().err
