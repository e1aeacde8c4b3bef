"""What is measured of an arm, by hand."""

import pytest

from tests.studies.claims.made_arms import OPTIMUM, arm, trial_of


def test_the_last_ten_are_averaged_and_all_where_there_are_fewer() -> None:
    own = arm("parts", "nested", [trial_of([0.0, 0.0, *[5.0] * 9, 15.0]), trial_of([1.0, 3.0])])
    assert own.last_ten.tolist() == [6.0, 2.0]
    assert own.final.tolist() == [15.0, 3.0]
    assert own.best.tolist() == [15.0, 3.0]


def test_the_optimum_is_reached_where_a_greedy_episode_first_scores_it() -> None:
    own = arm("images", "images", [trial_of([3.0, OPTIMUM, 4.0, OPTIMUM]), trial_of([3.0, 20.0])])
    assert [trial.episodes_to_optimum for trial in own.trials] == [60, None]


def test_a_budget_is_what_every_trial_had_spent() -> None:
    own = arm("materials", "nested", [trial_of([1.0] * 3), trial_of([1.0] * 2, steps_each=200)])
    assert own.least_cost("steps") == 300
    assert own.least_cost("updates") == 180


def test_within_a_budget_what_was_evaluated_later_does_not_count() -> None:
    scores = [float(number) for number in range(1, 13)]
    own = arm("materials", "nested", [trial_of(scores), trial_of(scores, steps_each=300)])
    assert own.within(1200, "steps").tolist() == [7.5, 2.5]
    assert own.within(1080, "updates").tolist() == [7.5, 7.5]


def test_early_is_the_first_third_of_a_budget_from_its_first_evaluation_on() -> None:
    own = arm("materials", "nested", [trial_of([4.0, 8.0, 100.0]), trial_of([6.0, 100.0], steps_each=250)])
    assert own.early(600, "steps").tolist() == [6.0, 6.0]
    assert own.early(30, "steps").tolist() == pytest.approx([4.0, 6.0])
