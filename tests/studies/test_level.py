"""How often a test of equal means errs, simulated: no more often than α, unlike a test of the plain difference."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.studies import inference
from mc_nested.studies.inference import ALPHA, contrast, exceeds

pytestmark = pytest.mark.slow

EXPERIMENTS = 1500

ERROR = 3 * (ALPHA * (1 - ALPHA) / EXPERIMENTS) ** 0.5
"""Three standard errors of a simulated share of α."""

Made = Callable[[np.random.Generator], Float64s]


def normal(deviation: float, trials: int = 10) -> Made:
    return lambda random: random.normal(0, deviation, trials)


def peaked(deviation: float) -> Made:
    return lambda random: random.laplace(0, deviation, 10)


def scores(most: int) -> Made:
    """Draw whole blocks about a mean of 17, with ties."""
    return lambda random: 17 + random.integers(-most, most + 1, 10).astype(np.float64)


def skewed(deviation: float) -> Made:
    return lambda random: deviation * (random.exponential(1, 10) - 1)


def unstudentised(left: Float64s, right: Float64s) -> float:
    found = stats.permutation_test(
        (left, right),
        lambda one, other, axis: one.mean(axis=axis) - other.mean(axis=axis),
        n_resamples=inference.RESAMPLES,
        vectorized=True,
        alternative="greater",
        rng=np.random.default_rng(0),
    )
    return float(found.pvalue)


def level(test: Callable[[Float64s, Float64s], float], left: Made, right: Made) -> float:
    """Return how often the test finds a difference between two agents whose means are equal."""
    random = np.random.default_rng(11)
    return sum(test(left(random), right(random)) < ALPHA for _ in range(EXPERIMENTS)) / EXPERIMENTS


@pytest.fixture(autouse=True)
def fewer_permutations(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inference, "RESAMPLES", 1999)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (normal(1), normal(1)),
        (normal(1), normal(10)),
        (normal(10), normal(1)),
        (peaked(1), peaked(5)),
        (scores(1), scores(6)),
        (scores(6), scores(1)),
    ],
    ids=["alike", "wider right", "wider left", "peaked", "scores, wider right", "scores, wider left"],
)
def test_the_studentised_test_keeps_its_level_at_ten_trials_of_unequal_spreads(left: Made, right: Made) -> None:
    assert level(exceeds, left, right) <= ALPHA + ERROR


def test_the_unstudentised_test_errs_too_often_when_the_wider_agent_has_fewer_trials() -> None:
    ours, theirs = (level(test, normal(4), normal(1, trials=30)) for test in (exceeds, unstudentised))
    assert theirs > 2 * ALPHA + ERROR
    assert ours < 2 * ALPHA < theirs


def test_both_tests_err_too_often_at_ten_trials_when_one_agent_is_more_skewed() -> None:
    # What the report says about p-values of such trials.
    for test in (exceeds, unstudentised):
        assert 2 * ALPHA < level(test, skewed(1), skewed(5)) < 3.5 * ALPHA


@pytest.mark.parametrize(
    "made", [normal(1), scores(6), peaked(1), skewed(1)], ids=["normal", "scores", "peaked", "skewed"]
)
def test_a_difference_of_differences_keeps_the_level_at_ten_trials(made: Made) -> None:
    random = np.random.default_rng(12)
    found = [
        contrast([made(random) for _ in range(4)], [1.0, -1.0, -1.0, 1.0])[0].claim < ALPHA for _ in range(EXPERIMENTS)
    ]
    assert np.mean(found) <= ALPHA + ERROR
