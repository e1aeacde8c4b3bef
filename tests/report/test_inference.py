"""Tests and intervals against values worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arrays import Float64s
from mc_nested.report.inference import (
    ahead,
    alike,
    difference_interval,
    exceeds,
    holm,
    mean_interval,
    mostly,
    share_interval,
)


def of(*trials: float) -> Float64s:
    return np.array(trials, dtype=np.float64)


def test_of_twenty_splits_only_the_one_at_hand_is_as_extreme() -> None:
    assert exceeds(of(4, 5, 6), of(1, 2, 3)) == 1 / 20
    assert exceeds(of(1, 2, 3), of(4, 5, 6)) == 1


def test_splits_that_tie_count_as_extreme() -> None:
    # Of the six pairs out of 1, 2, 2, 3, three sum to 4 or less and three to 4 or more, 1 + 3 and the two 2 + 2 alike.
    assert exceeds(of(2, 3), of(1, 2)) == pytest.approx(2 / 6)
    assert exceeds(of(2, 2), of(1, 3)) == pytest.approx(4 / 6)


def test_identical_trials_decide_nothing() -> None:
    assert exceeds(of(21, 21, 21), of(21, 21, 21)) == 1


def test_the_smallest_p_of_drawn_permutations_counts_the_trials_at_hand() -> None:
    assert exceeds(np.arange(20, 30.0), np.arange(10.0)) == pytest.approx(1 / 10_000, rel=0.5)


def test_drawn_permutations_are_the_same_again() -> None:
    left, right = np.arange(3, 13.0), np.arange(10.0)
    assert exceeds(left, right) == exceeds(left, right)
    # 4,520 of all 184,756 splits have as great a sum.
    assert exceeds(left, right) == pytest.approx(0.02446, abs=0.004)


def test_ahead_is_tested_against_level_and_against_a_block() -> None:
    assert ahead(of(4, 5, 6), of(1, 2, 3), margin=1) == (1 / 20, 1)
    # One block less than 1, 2, 3 is 0, 1, 2: all below 4, 5, 6.
    assert ahead(of(1, 2, 3), of(4, 5, 6), margin=1) == (1, 1 / 20)


def test_level_trials_speak_against_being_ahead() -> None:
    tails = ahead(np.full(6, 21.0), np.full(6, 21.0), margin=1)
    assert tails == pytest.approx((1, 1 / 924))


def test_a_lead_smaller_than_a_block_is_a_lead() -> None:
    tails = ahead(np.full(6, 20.5), np.full(6, 20.0), margin=1)
    assert tails == pytest.approx((1 / 924, 1 / 924))


def test_alike_takes_both_one_sided_tests() -> None:
    # A block added to either puts every trial of it above the other's.
    assert alike(np.full(3, 20.0), np.full(3, 20.5), margin=1) == (1 / 20, 1)


def test_two_blocks_apart_is_not_alike_either_way_round() -> None:
    apart = pytest.approx((1, 2 / 20))
    assert alike(of(7, 7, 7), of(5, 5, 5), margin=1) == apart
    assert alike(of(5, 5, 5), of(7, 7, 7), margin=1) == apart


def test_a_difference_of_exactly_the_margin_is_undecided() -> None:
    assert alike(of(6, 6, 6), of(5, 5, 5), margin=1) == (1, 1)


def test_ten_of_ten_is_two_to_the_minus_ten() -> None:
    assert mostly(10, 10) == pytest.approx((1 / 1024, 1))
    assert mostly(0, 10) == pytest.approx((1, 1 / 1024))
    assert mostly(1, 1) == (0.5, 1)


def test_the_exact_interval_of_a_share() -> None:
    # Clopper and Pearson, 10 of 10: the share whose tenth power is 0.025.
    assert share_interval(10, 10) == pytest.approx((0.025**0.1, 1))
    assert share_interval(0, 10) == pytest.approx((0, 1 - 0.025**0.1))


def test_holm_by_hand() -> None:
    # 3 x 0.01, 2 x 0.03, and the last no less than the one before it.
    assert holm([0.04, 0.01, 0.03]) == pytest.approx([0.06, 0.03, 0.06])
    assert holm([0.9, 0.6]) == [1, 1]
    assert holm([]) == []


@given(st.lists(st.floats(0, 1), min_size=1))
def test_holm_keeps_the_order_and_lies_between_no_correction_and_bonferroni(p_values: list[float]) -> None:
    adjusted = holm(p_values)
    for p, corrected in zip(p_values, adjusted, strict=True):
        assert p <= corrected <= min(1.0, len(p_values) * max(p_values))
    order = sorted(range(len(p_values)), key=lambda index: p_values[index])
    assert [adjusted[index] for index in order] == sorted(adjusted)
    assert adjusted[order[0]] == min(1.0, len(p_values) * p_values[order[0]])


def test_the_interval_of_a_difference_holds_it_and_is_the_same_again() -> None:
    left, right = of(18, 20, 21, 19), of(15, 14, 17, 16)
    low, high = difference_interval(left, right)
    assert 1.0 <= low < 4.0 < high <= 7.0
    assert difference_interval(left, right) == (low, high)


def test_the_interval_of_a_difference_is_about_two_standard_errors_wide() -> None:
    random = np.random.default_rng(1)
    low, high = difference_interval(random.normal(0, 1, 200), random.normal(0, 1, 200))
    assert high - low == pytest.approx(2 * 1.96 * (2 / 200) ** 0.5, rel=0.15)


def test_trials_that_agree_have_an_interval_without_width() -> None:
    assert difference_interval(of(21, 21), of(20, 20)) == (1, 1)
    assert mean_interval(of(21, 21)) == (21, 21)


def test_a_single_trial_has_no_interval() -> None:
    assert mean_interval(of(21)) is None
