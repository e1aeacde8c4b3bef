"""Only learning needs torch: everything that plays, looks or calibrates runs where it can't be imported."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from mc_nested.cli.app import VERBS
from mc_nested.learn.runs.policies import FILE as POLICIES
from tests.cli.running import run

LEARNING = ("train", "cooperate", "reproduce", "sweep", "benchmark")

BLOCKED = "import sys; sys.modules['torch'] = None; "
COMMAND = BLOCKED + "from mc_nested.cli.app import main; main(sys.argv[1:])"


def without_torch(code: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", code, *(str(argument) for argument in arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_every_verb_that_does_not_learn_loads_without_torch() -> None:
    modules = [f"mc_nested.cli.{verb.replace('-', '_')}" for verb in VERBS if verb not in LEARNING]
    modules += ["calibration.calibrate_all", "sim.client.client", "mc_nested.live.session"]
    loaded = without_torch(f"{BLOCKED}import importlib; [importlib.import_module(name) for name in {modules}]")
    assert loaded.returncode == 0, loaded.stderr


def test_a_training_is_evaluated_and_played_without_torch(trained: Path) -> None:
    scores = json.loads((trained / "summary.json").read_text())["final_scores"]
    evaluated = without_torch(COMMAND, "evaluate", trained, "--json")
    assert evaluated.returncode == 0, evaluated.stderr
    assert json.loads(evaluated.stdout)["scores"] == scores
    played = without_torch(COMMAND, "play", trained)
    assert played.returncode == 0, played.stderr
    assert f"score {max(scores):g} of 21" in played.stdout


@pytest.mark.parametrize("verb", ["evaluate", "play"])
def test_a_training_of_an_older_version_says_that_it_needs_torch(
    trained: Path, tmp_path: Path, verb: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("config.toml", "episodes.csv"):
        (tmp_path / name).write_bytes((trained / name).read_bytes())
    (tmp_path / "checkpoint").mkdir()
    for path in (trained / "checkpoint").iterdir():
        if path.name != POLICIES:
            (tmp_path / "checkpoint" / path.name).write_bytes(path.read_bytes())
    monkeypatch.setitem(sys.modules, "torch", None)  # which is what the processes above do before anything else
    assert run(verb, tmp_path) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "reading a checkpoint needs torch: install torch" in said
