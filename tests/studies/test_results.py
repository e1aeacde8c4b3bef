"""The scripted builder's score, which claims rest on: by the rules alone, equal to the simulator's."""

from dataclasses import replace

import pytest

from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.env import step_in
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.studies.results import builders_score
from sim.grid import arena_env


def played(scenario: Scenario) -> float:
    """Return the builder's score in the simulator."""
    env = arena_env(scenario)
    env.reset(options={"material": scenario.materials[scenario.best_material].name})
    for step in build_with_materials(scenario):
        _, _, terminated, truncated, info = env.step(step_in(scenario, *step))
        if terminated or truncated:
            break
    return float(info["score"])


@pytest.mark.parametrize("name", ["line", "zigzag", "diamond"])
def test_the_builder_scores_the_optimum(name: str) -> None:
    scenario = load_scenario(name)
    assert builders_score(scenario) == scenario.optimum


@pytest.mark.parametrize("name", shipped_scenarios())
@pytest.mark.parametrize("share", [1.0, 0.5])
def test_the_builders_score_by_the_rules_equals_its_score_in_the_simulator(name: str, share: float) -> None:
    scenario = load_scenario(name)
    limit = max(scenario.blocks, int(share * len(build_with_materials(scenario))))
    limited = replace(scenario, step_limit=limit)
    assert builders_score(limited) == played(limited)
