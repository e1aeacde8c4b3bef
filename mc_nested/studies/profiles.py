"""What a benchmark measures: interquartile means, performance profiles and their intervals.

They are defined as in rliable (Agarwal et al., *Deep Reinforcement Learning at the Edge of the Statistical Precipice*,
NeurIPS 2021), with one difference: a trial's result is how many episodes it took, so that less is better, and a trial
that was never at the optimum took infinitely many. A profile is the share of trials within a number of episodes.

The bootstrap is stratified: designs are drawn again within their kind, and trials within their design. That is
rliable's bootstrap over tasks and runs. A bootstrap over runs alone would have no width where a design has one trial.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mc_nested.arena.design import kind_of_design
from mc_nested.arrays import Float64s, Int64s
from mc_nested.studies.inference import Interval, percentiles
from mc_nested.studies.table import Cells, episodes
from mc_nested.studies.trial import Trial, without_a_prior

RESAMPLES = 2000
"""Bootstrap resamples behind an interval."""

TRIMMED = 0.25
"""The share that an interquartile mean leaves out at either end."""


@dataclass(frozen=True)
class PlayedDesigns:
    """One contestant's trials on some designs.

    Args:
        played: episodes to the optimum, (designs, trials); infinite where it was never reached.
        without_a_prior: what each design should take without a prior, (designs,).
        kinds: each design's kind, the strata of the bootstrap.
    """

    played: Float64s
    without_a_prior: Float64s
    kinds: Sequence[str]


@dataclass(frozen=True)
class Measures:
    """A contestant's figures; episodes to the optimum may be infinite. No interval for fewer than two designs."""

    trials: int
    solved: int
    median: float
    mean: float
    interval: Interval | None
    within_twice: float
    worst: float
    without_a_prior: float

    def in_words(self) -> Cells:
        """Return the cells of a table."""
        ends = self.interval if self.interval and np.isfinite(self.interval.low) else None
        interval = f" ({episodes(ends.low)} to {episodes(ends.high)})" if ends else ""
        return (
            ("solved", f"{self.solved} of {self.trials}"),
            ("median", episodes(self.median)),
            ("interquartile mean (95 %)", f"{episodes(self.mean)}{interval}"),
            ("worst", episodes(self.worst)),
            ("without a prior", episodes(self.without_a_prior)),
            ("within twice that", f"{100 * self.within_twice:.3g} %"),
        )


def played_designs(trials: Sequence[Trial], kind: str | None = None) -> PlayedDesigns:
    """Return a contestant's trials, on all designs or on those of a kind."""
    by_design: dict[str, list[Trial]] = {}
    for trial in trials:
        if kind in (None, kind_of_design(trial.scenario.design)):
            by_design.setdefault(trial.scenario.name, []).append(trial)
    scenarios = [own[0].scenario for own in by_design.values()]
    return PlayedDesigns(
        np.array([played_by(own) for own in by_design.values()], dtype=np.float64),
        np.array([without_a_prior(scenario) for scenario in scenarios], dtype=np.float64),
        [kind_of_design(scenario.design) for scenario in scenarios],
    )


def played_by(trials: Sequence[Trial]) -> Float64s:
    """Return the episodes that each trial played to the optimum, (trials,); infinite where it was never there."""
    return np.array([np.inf if trial.played_to_optimum is None else trial.played_to_optimum for trial in trials])


def measures_of(trials: PlayedDesigns) -> Measures:
    """Return the figures of one design or more."""
    played = trials.played
    means = [interquartile_mean(played[drawn]) for drawn in resamples(trials)]
    return Measures(
        trials=played.size,
        solved=int(np.isfinite(played).sum()),
        median=float(np.median(played)),
        mean=interquartile_mean(played),
        interval=percentiles(means) if means else None,
        within_twice=float((played <= 2 * trials.without_a_prior[:, None]).mean()),
        worst=float(played.max()),
        without_a_prior=float(np.median(trials.without_a_prior)),
    )


def interquartile_mean(played: Float64s) -> float:
    """Return the mean of the middle half of all trials; infinite if one of those is."""
    ordered = np.sort(played, axis=None)
    cut = int(TRIMMED * len(ordered))
    return float(ordered[cut : len(ordered) - cut].mean())


def profile(played: Float64s, episodes: Int64s) -> Float64s:
    """Return the share of all trials that were at the optimum within each of those numbers of episodes."""
    ordered = np.sort(played, axis=None)
    return np.searchsorted(ordered, episodes, side="right") / len(ordered)


def profile_band(trials: PlayedDesigns, episodes: Int64s) -> tuple[Float64s, Float64s] | None:
    """Return the profile's 95 % interval at each of those numbers; None for fewer than two designs."""
    drawn = [profile(trials.played[indices], episodes) for indices in resamples(trials)]
    if not drawn:
        return None
    low, high = np.percentile(drawn, [2.5, 97.5], axis=0)
    return low, high


def resamples(trials: PlayedDesigns) -> Iterator[tuple[Int64s, Int64s]]:
    """Return indices of ``played`` for each resample, always the same; none for fewer than two designs.

    Designs are drawn with replacement within their kind, and for each of those as many trials as it has.
    """
    designs, runs = trials.played.shape
    if designs < 2:
        return
    random = np.random.default_rng(0)
    kinds = np.array(trials.kinds)
    strata = [np.flatnonzero(kinds == kind) for kind in dict.fromkeys(trials.kinds)]
    for _ in range(RESAMPLES):
        rows = np.concatenate([stratum[random.integers(len(stratum), size=len(stratum))] for stratum in strata])
        yield rows[:, None], random.integers(runs, size=(designs, runs))
