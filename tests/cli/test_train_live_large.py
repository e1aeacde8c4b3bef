"""The preset live builds designs past the paper's: a house of 40 blocks, two islands, and a square of 100 blocks."""

import json
from pathlib import Path

import pytest

from tests.cli.running import run


@pytest.mark.slow
@pytest.mark.parametrize("design", ["islands", "house", "square"])
def test_live_builds_all_of_it(design: str, tmp_path: Path) -> None:
    # Of the first seeds, 2 comes to the square soonest: eight episodes, of which each takes eight seconds.
    words: list[str | Path] = ["train", "--preset", "live", "--scenario", design, "--episodes", "50", "--seed", "2"]
    assert run(*words, "--stop-at-optimum", "--out", tmp_path / "run") == 0
    assert json.loads((tmp_path / "run" / "summary.json").read_text("utf-8"))["episodes_to_optimum"] != [None]
