"""How often the intervals of ten trials hold the mean, simulated: as often as they say, or nearest to it of three ways.

The bootstraps are the ways that were not taken.
"""

from collections.abc import Callable, Mapping
from typing import Literal

import numpy as np
import pytest
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.report.curve import t_interval
from mc_nested.studies.inference import coverage as told

pytestmark = pytest.mark.slow

TRIALS, EXPERIMENTS = 10, 3000

ERROR = 3 * (0.95 * 0.05 / EXPERIMENTS) ** 0.5
"""Three standard errors of a simulated share of 0.95."""

Ends = tuple[Float64s, Float64s]


def normal(random: np.random.Generator) -> Float64s:
    return random.normal(0, 1, (TRIALS, EXPERIMENTS))


def skewed(random: np.random.Generator) -> Float64s:
    return random.exponential(1, (TRIALS, EXPERIMENTS))


def scores(random: np.random.Generator) -> Float64s:
    """Draw scores: the optimum of 21 in six of ten trials, else 12 to 20 with equal chance; 19 on average."""
    at_optimum = random.random((TRIALS, EXPERIMENTS)) < 0.6
    return np.where(at_optimum, 21.0, random.integers(12, 21, (TRIALS, EXPERIMENTS)))


def two_ways(random: np.random.Generator) -> Float64s:
    """Draw the scores of trials that end with either of two policies."""
    return np.where(random.random((TRIALS, EXPERIMENTS)) < 0.5, 21.0, 16.0)


Made = Callable[[np.random.Generator], Float64s]

MADE: Mapping[Made, float] = {normal: 0.0, skewed: 1.0, scores: 0.6 * 21 + 0.4 * 16, two_ways: 18.5}
"""Ways to make trials, and their mean."""


def bootstrapped(method: Literal["percentile", "BCa"]) -> Callable[[Float64s], Ends]:
    def interval(trials: Float64s) -> Ends:
        found = stats.bootstrap(
            (trials,), np.mean, axis=0, n_resamples=999, batch=100, method=method, rng=np.random.default_rng(0)
        )
        return np.asarray(found.confidence_interval.low), np.asarray(found.confidence_interval.high)

    return interval


def coverage(interval: Callable[[Float64s], Ends], made: Made) -> float:
    low, high = interval(made(np.random.default_rng(7)))
    return float(((low <= MADE[made] + 1e-9) & (MADE[made] - 1e-9 <= high)).mean())


@pytest.mark.filterwarnings("ignore::scipy.stats.DegenerateDataWarning", "ignore:invalid value:RuntimeWarning")
def test_students_t_covers_closest_to_95_percent_of_three_kinds_of_intervals() -> None:
    off = {
        name: sum(abs(coverage(interval, made) - 0.95) for made in MADE)
        for name, interval in {
            "t": t_interval,
            "percentile": bootstrapped("percentile"),
            "BCa": bootstrapped("BCa"),
        }.items()
    }
    assert min(off, key=lambda name: off[name]) == "t", off
    assert coverage(bootstrapped("percentile"), normal) < 0.95 - ERROR


def test_the_t_interval_covers_95_percent_on_normal_trials() -> None:
    assert coverage(t_interval, normal) == pytest.approx(0.95, abs=ERROR)


def test_the_t_interval_covers_89_to_95_percent_on_skewed_trials_and_tied_scores() -> None:
    assert 0.89 < coverage(t_interval, skewed) < 0.95
    assert 0.89 < coverage(t_interval, scores) < 0.95


def test_the_t_interval_of_trials_that_are_mostly_at_the_optimum_would_hold_their_mean_far_too_seldom() -> None:
    random = np.random.default_rng(5)
    made = np.where(random.random((TRIALS, EXPERIMENTS)) < 0.9, 21.0, random.integers(10, 21, (TRIALS, EXPERIMENTS)))
    low, high = t_interval(made)  # without the highest score, it doesn't know where they are
    mean = 0.9 * 21 + 0.1 * 15
    assert ((low <= mean) & (mean <= high)).mean() == pytest.approx(0.64, abs=0.05)
    assert np.isnan(t_interval(made, 21.0)[0]).mean() > 0.99


def test_the_cut_at_the_optimum_only_lowers_upper_ends_to_the_highest_score() -> None:
    made = scores(np.random.default_rng(7))
    given = (made == 21).mean(axis=0) < 0.5
    (low, high), (cut_low, cut_high) = t_interval(made), t_interval(made, 21.0)
    assert (high[given] > 21.0).any()
    np.testing.assert_array_equal(cut_low[given], low[given])
    np.testing.assert_array_equal(cut_high[given], np.minimum(high, 21.0)[given])
    assert np.isnan(cut_low[~given]).all()
    assert np.isnan(cut_high[~given]).all()


def test_intervals_of_trials_that_all_agree_have_no_width() -> None:
    made = scores(np.random.default_rng(7))
    agree = np.ptp(made, axis=0) == 0
    low, high = t_interval(made)
    assert agree.mean() == pytest.approx(0.6**10, abs=0.004)  # nearly all of them at the optimum
    assert (low[agree] == high[agree]).all()
    assert (low[agree] == made[0, agree]).all()


@pytest.mark.parametrize("made", [normal, skewed, two_ways])
def test_the_coverage_told_from_thirty_trials_is_near_the_true_one(made: Made) -> None:
    # Of thirty trials' shape, as a report has it; the true one is that of the shape they are drawn from.
    random = np.random.default_rng(3)
    drawn = np.concatenate([made(random) for _ in range(3)])
    low, high = t_interval(drawn)
    true = ((low <= MADE[made]) & (MADE[made] <= high)).mean()
    assert told(drawn[:, :40]).mean() == pytest.approx(true, abs=0.03)
