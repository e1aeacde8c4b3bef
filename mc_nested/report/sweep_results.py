"""The results of a sensitivity run, and each variant's effect on each scenario compared with its agent's base."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.atomic_file import atomic_write
from mc_nested.report.inference import Interval, difference_interval


class SweepRow(NamedTuple):
    """One trial; scores are r_M of greedy episodes. An empty choice is the base; None: the optimum was never reached.

    ``final_score`` is that of the policy that the run keeps, ``mean_score`` the mean over its evaluations.
    """

    agent: str
    choice: str
    value: str
    scenario: str
    trial: int
    final_score: float
    best_score: float
    mean_score: float
    episodes_to_optimum: int | None


@dataclass(frozen=True)
class Sweep:
    """A sensitivity run: its rows, and what is needed to read them.

    Args:
        preset: its name.
        episodes: of training in a trial.
        trials: of each variant on each scenario.
        seed: of all.
        optimum: each scenario's highest score, in the order of the scenarios.
        rows: of all trials, variant by variant.
    """

    preset: str
    episodes: int
    trials: int
    seed: int
    optimum: dict[str, float]
    rows: Sequence[SweepRow]


@dataclass(frozen=True)
class Effect:
    """What a variant does to a scenario: its trials' scores, and their difference from the base's with an interval."""

    agent: str
    choice: str
    value: str
    rows: Sequence[SweepRow]
    final: float
    mean: float
    final_difference: float
    mean_difference: float
    final_interval: Interval | None
    mean_interval: Interval | None


def effects_on(sweep: Sweep, scenario: str) -> list[Effect]:
    """Every variant's effect on that scenario, in the order of the rows; a base's is 0, without an interval."""
    trials: dict[tuple[str, str, str], list[SweepRow]] = {}
    for row in sweep.rows:
        if row.scenario == scenario:
            trials.setdefault((row.agent, row.choice, row.value), []).append(row)
    effects = []
    for (agent, choice, value), own in trials.items():
        base = trials[agent, "", ""]
        final, base_final = (_column(rows, "final_score") for rows in (own, base))
        mean, base_mean = (_column(rows, "mean_score") for rows in (own, base))
        tested = bool(choice) and len(own) > 1
        effects.append(
            Effect(
                agent=agent,
                choice=choice,
                value=value,
                rows=own,
                final=float(final.mean()),
                mean=float(mean.mean()),
                final_difference=float(final.mean() - base_final.mean()),
                mean_difference=float(mean.mean() - base_mean.mean()),
                final_interval=difference_interval(final, base_final) if tested else None,
                mean_interval=difference_interval(mean, base_mean) if tested else None,
            )
        )
    return effects


def write_rows(path: Path, rows: Sequence[SweepRow]) -> None:
    """Write them as CSV, atomically; OSError if the disk refuses."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(SweepRow._fields)
        writer.writerows(rows)


def _column(rows: Sequence[SweepRow], name: str) -> Float64s:
    return np.array([getattr(row, name) for row in rows], dtype=np.float64)
