"""Tests and intervals against values worked out by hand."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arrays import Float64s
from mc_nested.studies.inference import (
    ahead,
    alike,
    coverage,
    exceeds,
    holm,
    mean_interval,
    mostly,
    no_worse,
    share_interval,
    within,
)


def of(*trials: float) -> Float64s:
    return np.array(trials, dtype=np.float64)


def test_the_p_value_is_1_in_8_when_only_the_signs_at_hand_give_as_high_a_mean() -> None:
    assert exceeds(of(1, 2, 3)) == 1 / 8
    assert exceeds(of(-1, -2, -3)) == 1


def test_tied_signs_count_as_high() -> None:
    # Of the eight sums of ±1 ±1 ±2 the sum at hand, 2, is exceeded by 4, and equalled by +1 -1 +2 and -1 +1 +2.
    assert exceeds(of(1, -1, 2)) == 3 / 8


@pytest.mark.parametrize("score", [21.0, 20.1, 0.1 + 0.2, 0.0, -5.0])
def test_trials_that_are_the_same_have_a_p_value_of_1(score: float) -> None:
    assert exceeds(np.full(3, score) - np.full(3, score)) == 1


def test_rounding_errors_do_not_count_as_a_difference() -> None:
    # 0.1 + 0.2 isn't 0.3 to the last bit.
    assert exceeds(np.full(6, 0.1 + 0.2) - np.full(6, 0.3)) == 1
    assert exceeds(np.full(6, 0.3), than=0.1 + 0.2) == 1


def test_a_pair_without_a_difference_says_nothing() -> None:
    assert exceeds(of(1, 2, 3, 0, 0)) == exceeds(of(1, 2, 3))


@given(st.lists(st.integers(-4, 4), min_size=1, max_size=7), st.integers(-2, 2))
def test_the_exact_p_value_is_the_share_of_signs_that_give_as_high_a_mean(found: list[int], than: int) -> None:
    beyond = [difference - than for difference in found]
    sums = [
        sum(sign * each for sign, each in zip(signs, beyond, strict=True))
        for signs in itertools.product((1, -1), repeat=len(beyond))
    ]
    assert exceeds(of(*found), than) == pytest.approx(np.mean([each >= sum(beyond) for each in sums]))


def test_the_smallest_p_value_of_drawn_signs_counts_those_at_hand() -> None:
    assert exceeds(np.arange(1, 31.0)) == 1 / 10_000


def test_drawn_signs_repeat_and_come_close_to_the_exact_p_value() -> None:
    # 15 of 20 the same way: the binomial tail, 21,700 of 2**20.
    found = of(*[1] * 15, *[-1] * 5)
    assert exceeds(found) == exceeds(found)
    assert exceeds(found) == pytest.approx(21_700 / 2**20, abs=0.005)


def test_ahead_tests_for_a_lead_and_for_being_behind() -> None:
    assert ahead(of(1, 2, 3)) == (1 / 8, 1, None)
    assert ahead(of(-1, -2, -3)) == (1, 1 / 8, None)


def test_level_trials_are_within_a_block_and_neither_ahead_nor_behind() -> None:
    assert ahead(np.zeros(6), margin=1) == (1, 1, 1 / 64)


def test_a_steady_lead_smaller_than_a_block_is_ahead_and_within_a_block() -> None:
    assert ahead(np.full(6, 0.5), margin=1) == (1 / 64, 1, 1 / 64)


def test_a_steady_lead_of_two_blocks_is_ahead_and_not_within_a_block() -> None:
    assert ahead(np.full(6, 2.0), margin=1) == (1 / 64, 1, 1)


@given(st.lists(st.floats(-3, 3), min_size=2, max_size=9))
def test_what_is_tested_for_and_against_is_never_shown_together(found: list[float]) -> None:
    for tails in (ahead(of(*found), 1.0), alike(of(*found), 1.0), no_worse(of(*found), 1.0)):
        assert max(tails.claim, tails.against) >= 0.5


def test_alike_takes_both_one_sided_tests() -> None:
    assert alike(np.full(3, -0.5), margin=1) == (1 / 8, 1, None)
    assert within(np.full(3, -0.5), 1.0) == 1 / 8


def test_scores_two_blocks_apart_are_not_alike_in_either_order() -> None:
    assert alike(np.full(3, 2.0), margin=1) == (1, 2 / 8, None)
    assert alike(np.full(3, -2.0), margin=1) == (1, 2 / 8, None)


def test_a_difference_of_exactly_the_margin_is_undecided() -> None:
    assert alike(np.full(6, 1.0), margin=1) == (1, 1, None)


def test_no_worse_tests_for_being_less_than_the_margin_behind() -> None:
    assert no_worse(np.full(6, -0.5), 1.0) == (1 / 64, 1, None)
    assert no_worse(np.full(6, -1.5), 1.0) == (1, 1 / 64, None)


def test_the_p_value_of_ten_successes_in_ten_is_two_to_the_minus_ten() -> None:
    assert mostly(10, 10) == pytest.approx((1 / 1024, 1, None))
    assert mostly(0, 10) == pytest.approx((1, 1 / 1024, None))
    assert mostly(1, 1) == (0.5, 1, None)


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


def test_the_interval_of_a_mean_is_students() -> None:
    # Deviation 1, so an error of 1 / sqrt(3), and t with two degrees of freedom is 4.3027 at 0.975.
    assert mean_interval(of(4, 5, 6)) == pytest.approx((5 - 4.3027 / 3**0.5, 5 + 4.3027 / 3**0.5), abs=1e-4)


def test_the_interval_of_a_mean_ends_at_the_highest_score() -> None:
    found = mean_interval(of(19, 20, 21), highest=21)
    assert found is not None
    assert found.high == 21
    assert found.low == pytest.approx(20 - 4.3027 / 3**0.5, abs=1e-3)


@pytest.mark.parametrize("trials", [of(20, 21), of(19, 21, 21), of(21, 21, 21)])
def test_there_is_no_interval_of_a_mean_where_half_of_the_trials_are_at_the_highest_score(trials: Float64s) -> None:
    assert mean_interval(trials, highest=21) is None
    assert np.isnan(coverage(trials[:, None], 21.0)).all()


@pytest.mark.parametrize("score", [17.0, 20.1])
def test_trials_that_agree_have_an_interval_without_width(score: float) -> None:
    assert mean_interval(np.full(10, score), 21.0) == pytest.approx((score, score))
    assert coverage(np.full((10, 1), score), 21.0) == 1


def test_a_single_trial_has_no_interval() -> None:
    assert mean_interval(of(20), 21.0) is None


def test_coverage_of_two_trials_is_the_share_of_drawn_pairs_that_hold_their_mean() -> None:
    # Two trials, two draws: the mean is held unless both draws are the same one, which happens in half of them.
    assert coverage(of(4, 6)[:, None]) == pytest.approx(0.5, abs=0.04)


def test_coverage_is_told_for_each_measure_by_itself() -> None:
    trials = np.column_stack((np.arange(10.0), [17.0] * 9 + [10.0]))
    alone = [coverage(trials[:, [at]])[0] for at in (0, 1)]
    np.testing.assert_array_equal(coverage(trials), alone)
    # The one that differs isn't drawn in 0.9 ** 10 of the experiments, and no interval holds the mean then.
    assert alone[1] == pytest.approx(1 - 0.9**10, abs=0.04)
