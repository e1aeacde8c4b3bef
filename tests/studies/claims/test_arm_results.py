"""Measures of an arm, by hand."""

import pytest

from tests.studies.claims.made_arms import OPTIMUM, arm, trial_of


def test_last_ten_averages_the_last_ten_evaluations_or_all_if_there_are_fewer() -> None:
    own = arm("parts", "nested", [trial_of([0.0, 0.0, *[5.0] * 9, 15.0]), trial_of([1.0, 3.0])])
    assert own.last_ten.tolist() == [6.0, 2.0]
    assert own.final.tolist() == [15.0, 3.0]
    assert own.best.tolist() == [15.0, 3.0]


def test_episodes_to_optimum_ends_at_the_first_greedy_episode_with_the_optimum() -> None:
    own = arm("images", "images", [trial_of([3.0, OPTIMUM, 4.0, OPTIMUM]), trial_of([3.0, 20.0])])
    assert [trial.episodes_to_optimum for trial in own.trials] == [60, None]


def test_least_cost_is_that_of_the_trial_that_spent_least() -> None:
    own = arm("materials", "nested", [trial_of([1.0] * 3), trial_of([1.0] * 2, steps_each=200)])
    assert own.least_cost("steps") == 300
    assert own.least_cost("updates") == 180


def test_evaluations_beyond_a_budget_do_not_count() -> None:
    scores = [float(number) for number in range(1, 13)]
    own = arm("materials", "nested", [trial_of(scores), trial_of(scores, steps_each=300)])
    assert own.within(1200, "steps").tolist() == [7.5, 2.5]
    assert own.within(1080, "updates").tolist() == [7.5, 7.5]


def test_early_scores_average_the_first_third_of_a_budget_with_at_least_one_evaluation() -> None:
    own = arm("materials", "nested", [trial_of([4.0, 8.0, 100.0]), trial_of([6.0, 100.0], steps_each=250)])
    assert own.early(600, "steps").tolist() == [6.0, 6.0]
    assert own.early(30, "steps").tolist() == pytest.approx([4.0, 6.0])
