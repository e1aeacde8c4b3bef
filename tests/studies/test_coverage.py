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
from mc_nested.studies.inference import difference_interval

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


def test_the_cut_at_the_optimum_only_lowers_upper_ends_to_the_highest_score() -> None:
    made = scores(np.random.default_rng(7))
    (low, high), (cut_low, cut_high) = t_interval(made), t_interval(made, 21.0)
    assert (high > 21.0).any()
    np.testing.assert_array_equal(cut_low, low)
    np.testing.assert_array_equal(cut_high, np.minimum(high, 21.0))


def test_intervals_of_trials_that_all_agree_have_no_width() -> None:
    made = scores(np.random.default_rng(7))
    agree = np.ptp(made, axis=0) == 0
    low, high = t_interval(made)
    assert agree.mean() == pytest.approx(0.6**10, abs=0.004)  # nearly all of them at the optimum
    assert (low[agree] == high[agree]).all()
    assert (low[agree] == made[0, agree]).all()


@pytest.mark.parametrize("ratio", [1.0, 5.0])
def test_the_interval_of_a_difference_covers_95_percent_with_equal_and_unequal_spreads(ratio: float) -> None:
    random = np.random.default_rng(3)
    held = 0
    for _ in range(EXPERIMENTS):
        low, high = difference_interval(random.normal(2, 1, TRIALS), random.normal(0, ratio, TRIALS))
        held += low <= 2 <= high
    assert held / EXPERIMENTS == pytest.approx(0.95, abs=ERROR)
