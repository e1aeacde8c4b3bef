"""The trials of two experiments as they were measured, and new ones drawn from them.

``measured_trials.csv`` has the measures of each trial of ``mc-nested reproduce --trials 30`` with seed 0 and with seed
31337, of claims (a) to (d) and (g): 60 trials of each agent on each design.
"""

import csv
from functools import cache
from pathlib import Path

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.studies.claims.contests import EARLY, FINAL, LAST_TEN, SPREAD

COLUMNS = {EARLY: "early", FINAL: "final", LAST_TEN: "last_ten", SPREAD: "spread"}
"""The column of each measure."""

SEEDS = (0, 31337)


@cache
def measured(agent: str, scenario: str, measure: str, seed: int | None = None) -> Float64s:
    """Return the measure of each trial of that agent there, in their order, (30,) of a seed or (60,) of both."""
    with (Path(__file__).parent / "measured_trials.csv").open(newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if (row["agent"], row["scenario"]) == (agent, scenario)]
    return np.array([float(row[COLUMNS[measure]]) for row in rows if seed in (None, int(row["seed"]))])


def drawn(trials: int, random: np.random.Generator) -> Int64s:
    """Return which trials an experiment of so many has, drawn from all with replacement, (trials,)."""
    return random.integers(0, len(measured("nested", "line", EARLY)), trials)
