"""The results of an ablation: a row for each trial of each part on each design, and what they come to."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.atomic_file import atomic_write
from mc_nested.report.inference import RESAMPLES, Interval


class AblationRow(NamedTuple):
    """One trial; scores are r_M of greedy episodes.

    ``played_to_optimum`` counts every real episode played until the first greedy one at the optimum, that one and the
    other greedy ones included; None: never. ``updates`` are of all networks, until the trial ended.
    """

    part: str
    base: str
    scenario: str
    trial: int
    optimum: float
    best_score: float
    played_to_optimum: int | None
    updates: int


@dataclass(frozen=True)
class AblationPart:
    """A line of an ablation: what is off, of which preset, and after how many training episodes it is given up."""

    name: str
    base: str
    what: str
    most_episodes: int


@dataclass(frozen=True)
class Ablation:
    """An ablation: its rows, and what is needed to read them.

    Args:
        trials: of each part on each scenario.
        seed: of all.
        optimum: each scenario's highest score, in the order of the scenarios.
        parts: in their order.
        rows: of all trials, part by part.
    """

    trials: int
    seed: int
    optimum: dict[str, float]
    parts: Sequence[AblationPart]
    rows: Sequence[AblationRow]


@dataclass(frozen=True)
class PartMeasures:
    """One part on one scenario: episodes (trials,), infinite where never solved; no interval for one trial."""

    played: Float64s
    solved: int
    median: float
    interval: Interval | None
    worst: float
    best_score: float
    updates: float


def measures_on(ablation: Ablation, scenario: str) -> list[tuple[AblationPart, PartMeasures]]:
    """What each part comes to on that scenario, in the order of the parts."""
    found = []
    for part in ablation.parts:
        own = [row for row in ablation.rows if (row.part, row.scenario) == (part.name, scenario)]
        played = np.array([np.inf if row.played_to_optimum is None else row.played_to_optimum for row in own])
        measures = PartMeasures(
            played=played,
            solved=int(np.isfinite(played).sum()),
            median=float(np.median(played)),
            interval=_interval_of_median(played),
            worst=float(played.max()),
            best_score=max(row.best_score for row in own),
            updates=float(np.median([row.updates for row in own])),
        )
        found.append((part, measures))
    return found


def write_rows(path: Path, rows: Sequence[AblationRow]) -> None:
    """Write them as CSV, atomically; OSError if the disk refuses."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(AblationRow._fields)
        writer.writerows(rows)


def _interval_of_median(played: Float64s) -> Interval | None:
    """A percentile bootstrap, always the same for the same trials."""
    if len(played) < 2:
        return None
    drawn = np.random.default_rng(0).integers(len(played), size=(RESAMPLES, len(played)))
    # No interpolation: there is nothing between a number and infinity.
    low, high = np.percentile(np.median(played[drawn], axis=1), [2.5, 97.5], method="inverted_cdf")
    return Interval(float(low), float(high))
