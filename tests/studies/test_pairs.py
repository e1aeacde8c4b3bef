"""Why trials of one number are tested as pairs: what they share shows in their scores."""

import pytest
from scipy import stats

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.studies.claims.contests import EARLY, HIERARCHICAL, NESTED, UNSOLVED
from tests.studies.claims.measured import SEEDS, measured


def test_nested_and_hierarchical_begin_with_the_same_main_networks() -> None:
    line, paper = load_scenario("line"), load_preset("paper")
    nested, hierarchical = (Agent(AGENT_SPECS[agent], [line] * 2, paper, seed=5) for agent in (NESTED, HIERARCHICAL))
    assert (nested.online()["main"] == hierarchical.online()["main"]).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_early_scores_of_nested_and_hierarchical_trials_of_one_number_are_correlated_on_the_zigzag(seed: int) -> None:
    nested, hierarchical = (measured(agent, UNSOLVED[0], EARLY, seed) for agent in (NESTED, HIERARCHICAL))
    found = stats.pearsonr(nested, hierarchical)
    assert found.statistic > 0.5
    assert found.pvalue < 0.01
