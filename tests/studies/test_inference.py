"""Tests and intervals against values worked out by hand."""

import itertools
import math
import statistics

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.studies.inference import (
    Interval,
    Tails,
    ahead,
    alike,
    contrast,
    difference_interval,
    exceeds,
    holm,
    mean_interval,
    mostly,
    no_worse,
    share_interval,
    studentised,
)


def of(*trials: float) -> Float64s:
    return np.array(trials, dtype=np.float64)


def test_the_p_value_is_1_in_20_when_only_the_given_split_is_as_extreme() -> None:
    assert exceeds(of(4, 5, 6), of(1, 2, 3)) == 1 / 20
    assert exceeds(of(1, 2, 3), of(4, 5, 6)) == 1


def test_tied_splits_count_as_extreme() -> None:
    # Of the six pairs out of 1, 2, 2, 3, two are (2, 3); (1, 3) and (2, 2) are level with the rest, (1, 2) below it.
    assert exceeds(of(2, 3), of(1, 2)) == pytest.approx(2 / 6)
    # Here these two are as extreme as the pair at hand, and so are the two that are above.
    assert exceeds(of(2, 2), of(1, 3)) == pytest.approx(4 / 6)


@pytest.mark.parametrize("score", [21.0, 20.1, 0.1 + 0.2, 0.0, -5.0])
def test_identical_trials_have_a_p_value_of_1(score: float) -> None:
    assert exceeds(np.full(3, score), np.full(3, score)) == 1


def test_rounding_errors_do_not_count_as_a_difference() -> None:
    # 0.1 + 0.2 isn't 0.3 to the last bit.
    assert exceeds(np.full(4, 0.1 + 0.2), np.full(4, 0.3)) == 1


def test_studentised_is_a_bounded_form_of_welchs_t() -> None:
    # A difference of 2, variances 1 of three each: t = 2 / sqrt(2 / 3), so t / sqrt(1 + t²) = 2 / sqrt(4 + 2 / 3).
    assert studentised(of(3, 4, 5), of(1, 2, 3)) == pytest.approx(2 / (4 + 2 / 3) ** 0.5)
    assert studentised(of(1, 2, 3), of(3, 4, 5)) == pytest.approx(-2 / (4 + 2 / 3) ** 0.5)


def test_studentised_without_any_spread_is_1_or_minus_1_or_0() -> None:
    assert studentised(of(1, 1), of(0, 0)) == 1
    assert studentised(of(0, 0), of(1, 1)) == -1
    assert studentised(of(1, 1), of(1, 1)) == 0


def test_the_steadier_of_two_splits_with_similar_differences_counts_as_more() -> None:
    assert studentised(of(5, 5, 5), of(4, 4, 4.5)) > studentised(of(2, 5, 8), of(1.5, 4, 7))


@given(
    st.lists(st.integers(0, 4), min_size=4, max_size=4),
    st.lists(st.integers(0, 4), min_size=3, max_size=3),
)
def test_the_exact_p_value_is_the_share_of_splits_that_are_as_extreme(left: list[int], right: list[int]) -> None:
    both = left + right
    splits = [set(split) for split in itertools.combinations(range(7), 4)]
    values = [
        welchs_t([both[at] for at in split], [both[at] for at in range(7) if at not in split]) for split in splits
    ]
    as_extreme = sum(value >= values[0] - 1e-9 for value in values)  # the first is the one at hand
    assert exceeds(of(*left), of(*right)) == pytest.approx(as_extreme / 35)


def welchs_t(left: list[int], right: list[int]) -> float:
    """Return Welch's t as the books have it; a large number in the place of infinity."""
    difference = statistics.mean(left) - statistics.mean(right)
    error = (statistics.variance(left) / len(left) + statistics.variance(right) / len(right)) ** 0.5
    return difference / error if error else math.copysign(1e6, difference) if difference else 0.0


def test_the_smallest_p_value_of_drawn_permutations_counts_the_given_split() -> None:
    assert exceeds(np.arange(20, 30.0), np.arange(10.0)) == pytest.approx(1 / 10_000, rel=0.5)


def test_drawn_permutations_repeat_and_come_close_to_the_exact_p_value() -> None:
    left, right = np.arange(3, 13.0), np.arange(10.0)
    assert exceeds(left, right) == exceeds(left, right)
    # 4,520 of all 184,756 splits have as great a sum, and with it as great a t.
    assert exceeds(left, right) == pytest.approx(0.02446, abs=0.004)


def test_ahead_tests_for_a_lead_and_for_a_lead_of_less_than_a_block() -> None:
    assert ahead(of(4, 5, 6), of(1, 2, 3), margin=1) == (1 / 20, 1)
    # One block less than 1, 2, 3 is 0, 1, 2: all below 4, 5, 6.
    assert ahead(of(1, 2, 3), of(4, 5, 6), margin=1) == (1, 1 / 20)


def test_level_trials_are_evidence_against_being_ahead() -> None:
    tails = ahead(np.full(6, 21.0), np.full(6, 21.0), margin=1)
    assert tails == pytest.approx((1, 1 / 924))


def test_a_steady_lead_smaller_than_a_block_counts_both_for_and_against() -> None:
    tails = ahead(np.full(6, 20.5), np.full(6, 20.0), margin=1)
    assert tails == pytest.approx((1 / 924, 1 / 924))


def test_alike_takes_both_one_sided_tests() -> None:
    # A block added to either puts every trial of it above the other's.
    assert alike(np.full(3, 20.0), np.full(3, 20.5), margin=1) == (1 / 20, 1)


def test_scores_two_blocks_apart_are_not_alike_in_either_order() -> None:
    apart = pytest.approx((1, 2 / 20))
    assert alike(of(7, 7, 7), of(5, 5, 5), margin=1) == apart
    assert alike(of(5, 5, 5), of(7, 7, 7), margin=1) == apart


def test_a_difference_of_exactly_the_margin_is_undecided() -> None:
    assert alike(of(6, 6, 6), of(5, 5, 5), margin=1) == (1, 1)


def test_the_p_value_of_ten_successes_in_ten_is_two_to_the_minus_ten() -> None:
    assert mostly(10, 10) == pytest.approx((1 / 1024, 1))
    assert mostly(0, 10) == pytest.approx((1, 1 / 1024))
    assert mostly(1, 1) == (0.5, 1)


def test_the_interval_of_a_share_is_clopper_and_pearsons() -> None:
    # Clopper and Pearson, 10 of 10: the share whose tenth power is 0.025.
    assert share_interval(10, 10) == pytest.approx((0.025**0.1, 1))
    assert share_interval(0, 10) == pytest.approx((0, 1 - 0.025**0.1))


def test_holms_correction_agrees_with_a_calculation_by_hand() -> None:
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


def test_the_interval_of_a_difference_is_welchs() -> None:
    # Variances 1 and 4 of three each: error sqrt(5 / 3), freedom (5 / 3)² / ((1 / 3)² / 2 + (4 / 3)² / 2) = 50 / 17.
    half = stats.t.ppf(0.975, 50 / 17) * (5 / 3) ** 0.5
    assert difference_interval(of(4, 5, 6), of(0, 2, 4)) == pytest.approx((3 - half, 3 + half))


def test_the_interval_of_a_mean_is_students() -> None:
    # Deviation 1, so an error of 1 / sqrt(3), and t with two degrees of freedom is 4.3027 at 0.975.
    assert mean_interval(of(4, 5, 6)) == pytest.approx((5 - 4.3027 / 3**0.5, 5 + 4.3027 / 3**0.5), abs=1e-4)


def test_the_interval_of_a_mean_ends_at_the_highest_score() -> None:
    found = mean_interval(of(19, 21, 21), highest=21)
    assert found is not None
    assert found.high == 21
    assert found.low == pytest.approx(61 / 3 - 4.3027 * (4 / 3) ** 0.5 / 3**0.5, abs=1e-3)


@pytest.mark.parametrize("score", [21.0, 20.1])
def test_trials_that_agree_have_an_interval_without_width(score: float) -> None:
    assert difference_interval(np.full(10, score), np.full(10, score - 1)) == pytest.approx((1, 1))
    assert mean_interval(np.full(10, score), 21.0) == pytest.approx((score, score))


def test_the_interval_of_a_difference_keeps_one_agents_spread_where_the_others_trials_agree() -> None:
    # Freedom 2: that of the one with a spread.
    half = stats.t.ppf(0.975, 2) / 3**0.5
    assert difference_interval(of(21, 21, 21), of(4, 5, 6)) == pytest.approx((16 - half, 16 + half))


def test_a_single_trial_has_no_interval() -> None:
    assert mean_interval(of(21)) is None


def test_no_worse_tests_for_being_less_than_the_margin_behind() -> None:
    right = np.arange(10.0)
    assert no_worse(right - 0.5, right, 1.0) == (exceeds(right + 0.5, right), exceeds(right, right + 0.5))
    assert no_worse(right + 9, right, 1.0).claim < 0.001
    assert no_worse(right - 9, right, 1.0).against < 0.001


def test_a_contrast_of_two_groups_is_welchs_test() -> None:
    random = np.random.default_rng(2)
    left, right = random.normal(1, 1, 12), random.normal(0, 3, 9)
    tails, interval = contrast([left, right], [1.0, -1.0])
    above = stats.ttest_ind(left, right, equal_var=False, alternative="greater")
    assert tails == pytest.approx((above.pvalue, 1 - above.pvalue))
    assert interval == pytest.approx(difference_interval(left, right))


def test_a_contrast_of_four_groups_is_a_difference_of_differences() -> None:
    """The leads are 4 and 1, each mean's squared error 1 / 3; t = 3 / sqrt(4 / 3) with 8 degrees of freedom."""
    around = np.array([-1.0, 0.0, 1.0])
    tails, interval = contrast([around + 7, around + 3, around + 2, around + 1], [1.0, -1.0, -1.0, 1.0])
    assert tails.claim == pytest.approx(stats.t.sf(3 / (4 / 3) ** 0.5, 8))
    assert sum(interval) / 2 == pytest.approx(3)
    assert contrast([around, around], [1.0, 1.0])[0].claim == pytest.approx(0.5)


def test_a_contrast_without_any_spread_decides_nothing() -> None:
    same = np.full(10, 3.0)
    assert contrast([same + 1, same], [1.0, -1.0]) == (Tails(1.0, 1.0), Interval(1.0, 1.0))
