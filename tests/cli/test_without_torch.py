"""The torch engine alone needs torch: everything else runs where it can't be imported, training included."""

import json
import subprocess
import sys
from pathlib import Path

from mc_nested.cli.app import VERBS

BLOCKED = """
import sys

class NoTorch:
    def find_spec(self, name, *_):
        if name.partition(".")[0] == "torch":
            raise ModuleNotFoundError(name)

sys.meta_path.insert(0, NoTorch())
"""
COMMAND = BLOCKED + "from mc_nested.cli.app import main; main(sys.argv[1:])"


def without_torch(code: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", code, *(str(argument) for argument in arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_every_verb_loads_without_torch() -> None:
    modules = [f"mc_nested.cli.{verb.replace('-', '_')}" for verb in VERBS]
    modules += ["calibration.calibrate_all", "sim.client.client", "mc_nested.live.session"]
    loaded = without_torch(f"{BLOCKED}import importlib; [importlib.import_module(name) for name in {modules}]")
    assert loaded.returncode == 0, loaded.stderr


def test_a_training_is_saved_evaluated_and_played_without_torch(tmp_path: Path) -> None:
    out = tmp_path / "run"
    made = without_torch(COMMAND, "train", "--preset", "model-based", "--episodes", "3", "--out", out)
    assert made.returncode == 0, made.stderr
    (score,) = json.loads((out / "summary.json").read_text())["final_scores"]
    evaluated = without_torch(COMMAND, "runs", "evaluate", out, "--json")
    assert evaluated.returncode == 0, evaluated.stderr
    assert json.loads(evaluated.stdout)["scores"] == [score]
    played = without_torch(COMMAND, "play", out)
    assert played.returncode == 0, played.stderr
    assert f"score {score:g} of 21" in played.stdout


def test_the_shipped_agent_builds_without_torch() -> None:
    built = without_torch(COMMAND, "build", "line", "--agent")
    assert built.returncode == 0, built.stderr
    assert "built 11 of 11 blocks" in built.stdout


def test_the_torch_engine_says_that_torch_is_missing(tmp_path: Path) -> None:
    asked = without_torch(COMMAND, "train", "--engine", "torch", "--episodes", "3", "--out", tmp_path / "run")
    assert asked.returncode == 2
    assert asked.stderr.count("\n") == 1
    assert "torch is missing: install torch, or take --engine compiled" in asked.stderr
    assert not (tmp_path / "run").exists()


def test_a_torch_that_cannot_be_loaded_is_named_with_its_reason(tmp_path: Path) -> None:
    (tmp_path / "torch.py").write_text('raise OSError("no c10.dll")', "utf-8")
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); from mc_nested.cli.app import main; main(sys.argv[1:])"
    asked = without_torch(code, "train", "--engine", "torch", "--episodes", "3", "--out", tmp_path / "run")
    assert asked.returncode == 2
    assert asked.stderr.count("\n") == 1
    assert "torch can't be loaded, no c10.dll: reinstall it, or take --engine compiled" in asked.stderr
