"""From the command line to the pixels: trained in the simulator, built in a real window, checked on its server.

The window is the stand-in's (scripts/standin.py); its oracle knows the world without looking at the screen.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path

import cv2
import pytest

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import draw_grid, load_scenario
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import load_profile
from tests.standin_fixture import Block, Standin


def completed(*arguments: str | Path, env: Mapping[str, str] = os.environ) -> subprocess.CompletedProcess[str]:
    """Run the command to its end, and return it; the test fails with what it says where it doesn't succeed."""
    words = [str(argument) for argument in arguments]
    command = [sys.executable, "-m", "mc_nested.cli", *words]
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done


def mc_nested(*arguments: str | Path, env: Mapping[str, str] = os.environ) -> str:
    """Run the command as ``completed`` does, and return what it prints."""
    return completed(*arguments, env=env).stdout


def standing(standin: Standin, arena: Arena) -> dict[Block, str]:
    """Return the blocks that the server has in the region that a reset clears."""
    return standin.blocks(*arena.region)


def built(arena: Arena, scenario: Scenario, material: str) -> dict[Block, str]:
    """Return the blocks of the whole design in that material."""
    block = scenario.materials[scenario.material_index(material)].block
    return {arena.block_of(cell): block for cell in scenario.design}


@pytest.mark.standin
@pytest.mark.parametrize(("design", "preset"), [("line", "paper"), ("diamond", "tuned")])
def test_a_policy_learnt_in_the_simulator_builds_its_design_in_a_real_window(
    design: str, preset: str, standin: Standin, tmp_path: Path
) -> None:
    run, scenario = tmp_path / "run", load_scenario(design)
    mc_nested("train", "--scenario", design, "--preset", preset, "--stop-at-optimum", "--out", run)
    found = json.loads(mc_nested("runs", "evaluate", run, "--json"))
    assert found["scores"] == [scenario.optimum]

    played = completed(
        *("play", run, "--backend", "live", "--profile", standin.profile, "--screenshots"),
        *("--record", tmp_path / "recording"),
        env=standin.env,
    )
    assert f"score {scenario.optimum:g} of {scenario.optimum:g}, in {found['materials'][0]}" in played.stdout
    arena = load_profile(standin.profile).marked_arena()
    assert standing(standin, arena) == built(arena, scenario, found["materials"][0])

    pictures = sorted((run / "screenshots").glob("*.png"))
    assert len(pictures) == found["steps"][0]
    sizes = {picture.shape for path in pictures if (picture := cv2.imread(str(path))) is not None}
    assert sizes == {(767, 1023, 3)}, "every picture shows the stand-in's window and nothing beside it"
    replayed = json.loads(mc_nested("replay", tmp_path / "recording", "--json", env=standin.env))
    # An episode that a stalled window cost starts over, and its actions are recorded, too.
    lost = played.stderr.count("the episode starts over")
    assert replayed["differences"] == []
    assert found["steps"][0] <= replayed["actions"] <= (lost + 1) * found["steps"][0], played.stderr
    assert replayed["read_anew"] > replayed["actions"]
    assert standin.errors() == []


@pytest.mark.standin
def test_training_goes_on_in_a_real_window_after_a_kill(standin: Standin, tmp_path: Path) -> None:
    tiny = tmp_path / "tiny.toml"
    grid = draw_grid(frozenset({(7, 13), (7, 12)}), 15)
    tiny.write_text(
        f'name = "tiny"\nstart = [7, 13]\nstep_limit = 4\ndesign = """\n{grid}"""\n'
        '[[materials]]\nname = "stone"\np = 0\nblock = "stone"\n'
    )
    preset = Path(__file__).parents[1] / "mc_nested" / "learn" / "presets" / "paper.toml"
    often = tmp_path / "often.toml"
    often.write_text(preset.read_text("utf-8").replace("evaluate_every = 30", "evaluate_every = 2"), "utf-8")
    run = tmp_path / "run"
    live = ["--backend", "live", "--profile", str(standin.profile), "--preset", str(often), "--episodes", "2"]
    command = [sys.executable, "-m", "mc_nested.cli", "train", "--scenario", str(tiny), *live, "--out", str(run)]
    process = subprocess.Popen(command, env=standin.env, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while not (run / "config.toml").exists() and time.monotonic() < deadline:
        time.sleep(0.1)
    process.terminate()
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130, said
    mc_nested("train", "--resume", run, env=standin.env)
    summary = json.loads((run / "summary.json").read_text())
    assert summary["episodes_done"] == [2]
    assert summary["backend"] == "live"
    assert len(summary["final_scores"]) == 1
    x, y, z = standin.position()
    time.sleep(1)
    assert standin.position() == (x, y, z), "no key stayed down"
