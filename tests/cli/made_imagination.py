"""A preset that imagines, small enough for designs of a few blocks to be learnt in a moment."""

from pathlib import Path

import tomlkit

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.preset import load_preset
from tests.learn.made_experiments import MATERIALS, scenario_text

SMALL = Scenario("small", frozenset({(2, 3), (2, 2)}), (2, 4), 16, MATERIALS, size=5)
BESIDE = Scenario("beside", frozenset({(1, 3), (1, 2)}), (2, 4), 16, MATERIALS, size=5)


def write_preset(path: Path) -> Path:
    """Return a preset file of that name."""
    live = load_preset("model-based").model_dump(exclude_none=True)
    live["hidden"] = [16, 16]
    path.write_text(tomlkit.dumps(live), "utf-8")
    return path


def write_scenario(path: Path, scenario: Scenario) -> Path:
    """Return a design file of that name."""
    path.write_text(scenario_text(scenario), "utf-8")
    return path
