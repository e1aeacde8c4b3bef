"""``mc-nested train --design-unknown``: its files, a resume after Ctrl+C, its policy, and its refusals."""

import json
import signal
from pathlib import Path

import pytest

from mc_nested.cli.training_end import next_steps
from mc_nested.learn.objectives import weights
from mc_nested.learn.runs.checkpoint import FILE
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from tests.cli.running import check_mistake, run, table

TRAIN = ["train", "--preset", "any-design", "--design-unknown", "--stop-at-optimum"]


@pytest.fixture(scope="module")
def line(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("runs") / "line"
    assert run(*TRAIN, "--out", out) == 0
    return out


def test_a_design_that_is_not_told_is_found_without_an_update(line: Path) -> None:
    summary = json.loads((line / "summary.json").read_text())
    assert (summary["final_scores"], summary["updates"], summary["networks"]) == ([21.0], 0, 2)
    played = len(table(line / "episodes.csv")) + len(table(line / "evaluations.csv"))
    assert summary["played_to_optimum"][0]["episodes"] == played <= 7
    assert summary["parameters"] > 10_000
    assert (line / "map.png").read_bytes().startswith(b"\x89PNG")


def test_what_was_found_is_evaluated_and_played(line: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "evaluate", line, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["scores"], found["materials"]) == ([21.0], ["stone"])
    assert run("play", line) == 0
    assert "score 21 of 21, in stone" in capsys.readouterr().out


def test_ctrl_c_saves_and_resume_goes_on_to_the_same_files(
    line: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    tick = Trainer.tick

    def tick_and_interrupt(trainer: Trainer) -> None:
        tick(trainer)
        if trainer.ticks == 70:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Trainer, "tick", tick_and_interrupt)
    assert run(*TRAIN, "--out", tmp_path / "stopped") == 130
    monkeypatch.setattr(Trainer, "tick", tick)
    assert "--resume" in capsys.readouterr().err
    assert run("train", "--resume", tmp_path / "stopped") == 0
    for name in ("episodes.csv", "evaluations.csv", "map.png", "curve.png", f"checkpoint/{FILE}"):
        assert (tmp_path / "stopped" / name).read_bytes() == (line / name).read_bytes(), name


def test_a_run_of_a_told_design_is_another_training(line: Path) -> None:
    config = RunFolder.open(line).config
    told = config.model_copy(update={"design_unknown": False})
    assert config.identity() != told.identity()
    assert "design_unknown" not in told.identity(), "so that a checkpoint from before there was that key still fits"
    assert config.title == "line, nested agent, preset any-design, design unknown"


def test_below_the_optimum_it_goes_on_from_the_beginning(line: Path) -> None:
    (more, *_) = next_steps(Path("x"), RunFolder.open(line).config, is_at_optimum=False)
    assert more.endswith(
        "mc-nested train --scenario line --design-unknown --preset any-design --episodes 400 --stop-at-optimum"
    )


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--preset", "tuned"], "--design-unknown is for the agent with objectives: add --preset any-design"),
        ([], "--design-unknown is for the agent with objectives: add --preset any-design"),
        (["--preset", "any-design", "--agent", "hierarchical"], "leave out --agent hierarchical"),
        (["--preset", "any-design", "--builders", "2"], "--builders doesn't go with --design-unknown: leave it out"),
        (["--preset", "any-design", "--start", "7,14"], "--start doesn't go with --design-unknown: leave it out"),
        (["--preset", "any-design", "--from", "DONE"], "--from doesn't go with --design-unknown: leave it out"),
        (["--preset", "any-design", "--games", "127.0.0.1"], "--games doesn't go with --design-unknown: leave it out"),
        (["--preset", "any-design", "--engine", "torch"], "--engine doesn't go with --design-unknown: leave it out"),
        (["--preset", "any-design", "--scenario", "flag"], "--design-unknown knows no parts, and flag has some"),
    ],
)
def test_a_mistake_is_refused_in_one_line(
    words: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check_mistake(["train", "--design-unknown", "--out", "NEW", *words], says, trained, tmp_path, capsys)


@pytest.mark.parametrize("words", [["--backend", "virtual"], ["--backend", "live"]])
def test_the_agent_is_trained_in_the_simulator_alone(
    words: list[str], trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    says = "--preset any-design trains in the simulator: leave out --backend, or add --design-unknown"
    check_mistake(["train", "--preset", "any-design", "--out", "NEW", *words], says, trained, tmp_path, capsys)


def test_broken_weights_are_an_error_before_there_is_a_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(weights, "FILE", str(tmp_path / "none.safetensors"))
    assert run(*TRAIN, "--out", tmp_path / "new") == 2
    assert "can't be read" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()
