"""What claims rest on: measures of a trial by hand, and the scripted builder's score.

That is by the rules alone, and equal to the simulator's.
"""

from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.env import step_in
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.studies.results import Curve, builders_score, curve_of, early_limit
from tests.arena.simulated import arena_env
from tests.studies.made_trials import LINE, made_arm, made_trial


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


def curve(episodes: list[int], scores: list[list[float]], trained: int, keeps_best: bool = False) -> Curve:
    return Curve(np.array(episodes), np.array(scores), trained, keeps_best)


@pytest.mark.parametrize(("episodes", "early"), [(30_000, 1000), (3000, 1000), (2999, 999), (90, 30)])
def test_the_early_limit_is_a_thousand_episodes_or_a_third(episodes: int, early: int) -> None:
    assert early_limit(episodes) == early


def test_the_early_score_is_the_mean_of_the_early_evaluations() -> None:
    seen = curve([500, 1000, 1500], [[2, 4, 21], [6, 7, 21]], trained=3000)
    assert seen.early.tolist() == [3.0, 6.5]


def test_the_final_score_is_that_of_the_last_evaluation() -> None:
    assert curve([30, 60], [[21, 3], [5, 20]], trained=60).final.tolist() == [3.0, 20.0]


def test_the_final_score_is_the_best_policys_where_that_is_kept() -> None:
    assert curve([30, 60], [[21, 3], [5, 20]], trained=60, keeps_best=True).final.tolist() == [21.0, 20.0]


def test_last_ten_averages_the_last_ten_evaluations_whichever_policy_is_kept() -> None:
    episodes = list(range(30, 3001, 30))
    scores = [[0.0] * 90 + [20.0] * 9 + [10.0], [0.0] * 89 + [99.0] + [21.0] * 10]
    for keeps_best in (False, True):
        assert curve(episodes, scores, 3000, keeps_best).last_ten.tolist() == [19.0, 21.0]


def test_last_ten_averages_the_last_third_if_shorter_than_ten_evaluations() -> None:
    assert curve([10, 20, 21, 30], [[-5, 50, 1, 2]], trained=30).last_ten.tolist() == [1.5]


def test_the_spread_is_the_standard_deviation_over_the_last_third() -> None:
    seen = curve([10, 20, 21, 25, 30], [[-5, 50, 1, 2, 3], [0, 0, 7, 7, 7]], trained=30)
    assert seen.spread.tolist() == [1.0, 0.0]


def test_measures_without_evaluations_are_empty() -> None:
    nothing = curve([], [[], []], trained=3000)
    assert [len(measure) for measure in (nothing.early, nothing.final, nothing.last_ten, nothing.spread)] == [0] * 4
    late = curve([3000], [[21], [20]], trained=3000)
    assert [len(measure) for measure in (late.early, late.final, late.last_ten, late.spread)] == [0, 2, 2, 0]


def test_the_curve_of_an_arm_does_not_depend_on_the_order_of_trials() -> None:
    arm = made_arm("nested", trials=2)
    scores = [[1.0, 20.0, 21.0], [2.0, 21.0, 19.0]]
    trials = [
        made_trial(arm, LINE, number, [(30 * at, score) for at, score in enumerate(own, 1)])
        for number, own in enumerate(scores)
    ]
    found = curve_of(trials)
    assert (found.episodes.tolist(), found.scores.tolist()) == ([30, 60, 90], scores)
    assert (found.trained, found.keeps_best) == (90, False)
    assert curve_of(trials[::-1]).scores.tolist() == scores
