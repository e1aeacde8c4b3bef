"""The preset model-based builds designs past the paper's: a house of 40 blocks, two islands, a square of 100 blocks."""

import json
from pathlib import Path

import pytest

from tests.cli.running import run


@pytest.mark.slow
@pytest.mark.parametrize("design", ["islands", "house", "square"])
def test_every_block_of_a_large_design_is_built(design: str, tmp_path: Path) -> None:
    # Of the first seeds, 2 comes to the square soonest: eight episodes, of which each takes eight seconds.
    words = ["train", "--preset", "model-based", "--scenario", design, "--episodes", "50", "--seed", "2"]
    assert run(*words, "--stop-at-optimum", "--out", tmp_path / "run") == 0
    assert json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))["episodes_to_optimum"] != [None]
