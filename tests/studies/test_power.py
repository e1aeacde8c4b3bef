"""How many trials would decide a claim: by tables, by hand, and by simulation."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from mc_nested.studies.inference import ALPHA, exceeds, mostly
from mc_nested.studies.power import MeanEffect, ShareEffect, deciding_trials


def one(effect: MeanEffect | ShareEffect, trials: int, alpha: float = ALPHA) -> float:
    return float(effect.power(np.array([trials]), alpha)[0])


@pytest.mark.parametrize(("difference", "trials"), [(0.5, 27), (0.8, 12), (1.0, 8)])
def test_a_mean_difference_takes_as_many_pairs_as_tables_of_the_paired_t_test_say(
    difference: float, trials: int
) -> None:
    """A one-sided paired t test, α = 0.05, power 0.8, by the mean difference in its own standard deviations."""
    assert deciding_trials([MeanEffect(difference, 1.0)]) == trials


def test_power_agrees_with_the_simulated_share_of_significant_t_tests() -> None:
    differences = np.random.default_rng(5).normal(1, 2, (20, 20_000))
    found = stats.ttest_1samp(differences, 0, alternative="greater").pvalue < ALPHA
    assert one(MeanEffect(1.0, 2.0), 20) == pytest.approx(np.mean(found), abs=0.015)


def test_a_difference_without_spread_takes_as_many_pairs_as_a_sign_flip_test_needs() -> None:
    assert exceeds(np.ones(5)) < ALPHA < exceeds(np.ones(4))
    assert deciding_trials([MeanEffect(2.0, 0.0)]) == 5


def test_a_difference_of_zero_is_never_shown() -> None:
    assert deciding_trials([MeanEffect(0.0, 1.0)]) is None
    assert deciding_trials([MeanEffect(0.0, 0.0)]) is None


@given(st.floats(0.05, 3.0), st.floats(0.1, 5.0), st.integers(4, 500))
def test_more_trials_have_more_power(above: float, spread: float, trials: int) -> None:
    effect = MeanEffect(above, spread)
    assert one(effect, trials) <= one(effect, trials + 1) + 1e-9


def test_a_share_takes_as_many_trials_as_the_binomial_test_needs() -> None:
    assert one(ShareEffect(1.0), 4) == 0.0
    assert one(ShareEffect(1.0), 5) == 1.0
    assert deciding_trials([ShareEffect(1.0)]) == 5
    # Of eight trials, seven have to be at the optimum: 0.9 ** 8 + 8 * 0.9 ** 7 * 0.1.
    assert one(ShareEffect(0.9), 8) == pytest.approx(0.9**8 + 8 * 0.9**7 * 0.1)


@pytest.mark.parametrize("trials", [5, 8, 10, 30])
def test_the_power_of_a_share_sums_the_probabilities_of_significant_counts(trials: int) -> None:
    shown = sum(
        stats.binom.pmf(count, trials, 0.7) for count in range(trials + 1) if mostly(count, trials).claim < ALPHA
    )
    assert one(ShareEffect(0.7), trials) == pytest.approx(shown)


def test_a_share_below_one_half_is_shown_against_the_claim() -> None:
    assert deciding_trials([ShareEffect(0.0)]) == 5
    assert deciding_trials([ShareEffect(0.5)]) is None


def test_a_share_needs_the_trials_from_which_its_power_stays_high() -> None:
    """The power of 0.7 is above 0.8 at 37 trials, and below again until 42: it rises in a saw-tooth."""
    power = ShareEffect(0.7).power(np.arange(37, 60), ALPHA)
    assert power[0] >= 0.8 > power[4]
    assert (power[5:] >= 0.8).all()
    assert deciding_trials([ShareEffect(0.7)]) == 42


def test_a_small_lead_takes_as_many_trials_as_show_that_it_is_one() -> None:
    """That it is less than a block is shown far sooner, and decides nothing."""
    assert deciding_trials([MeanEffect(0.1, 0.3)]) == 58


def test_a_large_lead_takes_as_many_pairs_as_a_sign_flip_test_needs() -> None:
    assert deciding_trials([MeanEffect(50.0, 1.0)]) == 5


def test_all_lines_of_a_claim_have_to_be_shown() -> None:
    alone, other = MeanEffect(1.0, 1.0), MeanEffect(1.1, 1.0)
    found, of_one = deciding_trials([alone, other]), deciding_trials([alone])
    assert found
    assert of_one
    assert found > of_one
    assert one(alone, found) * one(other, found) >= 0.8 > one(alone, found - 1) * one(other, found - 1)


def test_one_line_against_a_claim_is_enough_at_its_share_of_alpha() -> None:
    against, for_it = MeanEffect(-2.0, 1.0), MeanEffect(5.0, 1.0)
    found = deciding_trials([against, for_it])
    assert found
    assert float(against.opposite.power(np.array([found]), ALPHA / 2)[0]) >= 0.8
    assert float(against.opposite.power(np.array([found - 1]), ALPHA / 2)[0]) < 0.8


def test_no_number_of_trials_is_named_without_a_tested_line() -> None:
    assert deciding_trials([]) is None
