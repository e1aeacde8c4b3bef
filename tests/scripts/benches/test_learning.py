"""The benchmark of learning: a figure for each contestant, and nothing left in the temporary folder."""

import importlib.util
import json
import os
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from scripts.benches.learning import PAPER, flops_of_an_update, ours, summary

ROOT = Path(__file__).resolve().parents[3]


def test_flops_of_an_update_are_those_of_its_matrix_products() -> None:
    # 4 inputs, 32 and 32 nodes, 8 outputs; three passes forward, weights' gradients, and those of two layers' inputs.
    first, *others = [inputs * outputs for inputs, outputs in pairwise((4, 32, 32, 8))]
    assert flops_of_an_update() == 2 * 32 * (4 * first + 5 * sum(others))


def test_ratios_are_the_medians_of_the_ratios_of_each_round() -> None:
    loops = {"plain loop": [5.0, 10.0, 15.0], "plain loop, one": [5.0, 5.0, 5.0], "bmm": [1.0]}
    ours = {"compiled 1": [10.0, 40.0, 30.0], "torch 1": [4.0, 4.0, 5.0], "images 1": [1.0, 2.0, 3.0]}
    found = summary(loops | ours, [1], cores=2)
    assert (found["ours"], found["plain_loop"]) == ({"compiled 1": 30, "torch 1": 4, "images 1": 2}, 10)
    assert (found["ratio_torch"], found["ratio_torch_one_run"]) == (0.4, 0.8)
    assert (found["ratio_plain_loop"], found["ratio_one_run"], found["sb3"]) == (2.0, 6.0, None)


def test_new_runs_begin_once_all_runs_have_had_their_episodes() -> None:
    work = ours(2, PAPER.changed(episodes=1))
    updates = [work() for _ in range(100)]
    assert sum(updates[50:]) > 0


@pytest.mark.slow
def test_the_benchmark_leaves_nothing_in_the_temporary_folder(tmp_path: Path) -> None:
    env = {**os.environ, **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(tmp_path))}
    words = ["--runs", "1", "2", "--rounds", "1", "--slice-s", "0.05", "--json"]
    command = [sys.executable, "scripts/bench.py", "learning", *words]
    done = subprocess.run(command, cwd=ROOT, env=env, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == 0, done.stderr
    assert set(json.loads(done.stdout)["ours"]) == {"compiled 1", "compiled 2", "torch 1", "torch 2", "images 1"}
    assert (json.loads(done.stdout)["sb3"] is not None) is (importlib.util.find_spec("stable_baselines3") is not None)
    assert list(tmp_path.iterdir()) == []
