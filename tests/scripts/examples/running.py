"""Runs an example as its reader does: by its file, in an empty folder, with warnings as errors."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mc_nested.arena.scenario import Scenario
from tests.learn.made_experiments import MATERIALS, scenario_text

ROOT = Path(__file__).resolve().parents[3]

PAIR = Scenario("pair", frozenset({(2, 3), (2, 2)}), (2, 4), 12, MATERIALS, size=5)
"""Two blocks in an arena of 5 x 5 cells: learnt within seconds."""


def run(name: str, folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run the example of that name; no profile is found, and nothing is left in the folder."""
    before = sorted(folder.iterdir())
    homes = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "APPDATA"), str(folder))
    command = [sys.executable, "-W", "error", str(ROOT / "scripts" / "examples" / f"{name}.py"), *words]
    environment = {**os.environ, **homes, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False, timeout=600
    )
    assert sorted(folder.iterdir()) == before
    return done


def pair_in(folder: Path) -> str:
    """Return PAIR's file in that folder."""
    (folder / "pair.toml").write_text(scenario_text(PAIR), "utf-8")
    return str(folder / "pair.toml")


MISTAKES = pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--scenario", "castle"], "no scenario 'castle'"),
        (["--scenario", "castle.schem"], "castle.schem: there is no such file"),
        (["--backend", "live"], "no profile"),
    ],
)
"""What a user can do wrong with any example."""
