"""Why trials of one number are tested as pairs: what they share shows in their scores."""

import pytest
from scipy import stats

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.studies.claims.contests import HIERARCHICAL, NESTED, UNSOLVED
from tests.studies.claims.measured import SEEDS, TRIALS, curves_of


def test_nested_and_hierarchical_begin_with_the_same_main_networks() -> None:
    line, paper = load_scenario("line"), load_preset("paper")
    nested, hierarchical = (Agent(AGENT_SPECS[agent], [line] * 2, paper, seed=5) for agent in (NESTED, HIERARCHICAL))
    assert (nested.online()["main"] == hierarchical.online()["main"]).all()


@pytest.mark.parametrize("seed", SEEDS)
def test_early_scores_of_nested_and_hierarchical_trials_of_one_number_are_correlated_on_the_zigzag(seed: int) -> None:
    of_a_seed = TRIALS // len(SEEDS)
    first = SEEDS.index(seed) * of_a_seed
    curves = curves_of(range(first, first + of_a_seed))
    found = stats.pearsonr(*(curves[agent, UNSOLVED[0]].early for agent in (NESTED, HIERARCHICAL)))
    assert found.statistic > 0.5
    assert found.pvalue < 0.01
