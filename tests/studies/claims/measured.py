"""The trials of two experiments as they were measured, and experiments drawn from them.

``measured_trials.csv`` has the measures of each trial of ``mc-nested reproduce --trials 30`` with seed 0 and with seed
31337, of claims (a) to (d) and (g): 60 trials of each agent on each design.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from pathlib import Path
from typing import cast

import numpy as np

from mc_nested.arrays import Float64s, Int64s
from mc_nested.studies.claims.contests import HIERARCHICAL, LINE, NESTED, SINGLE, UNSOLVED, Curves

SEEDS = (0, 31337)

AGENTS, DESIGNS = (NESTED, HIERARCHICAL, SINGLE), (LINE, *UNSOLVED)

TRIALS = 60


@dataclass(frozen=True)
class MeasuredCurve:
    """What claims take from a curve, (trials,) each."""

    early: Float64s
    final: Float64s
    last_ten: Float64s
    spread: Float64s


MEASURES = tuple(MeasuredCurve.__dataclass_fields__)


@cache
def every_trial() -> Float64s:
    """Return all measures, (agents, designs, measures, trials), first all trials of the first seed."""
    with (Path(__file__).parent / "measured_trials.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = {key: [row for row in rows if (row["agent"], row["scenario"]) == key] for key in product(AGENTS, DESIGNS)}
    measures = [[[float(row[of]) for row in own] for of in MEASURES] for own in found.values()]
    return np.array(measures).reshape(len(AGENTS), len(DESIGNS), len(MEASURES), TRIALS)


def curves_of(trials: Sequence[int] | Int64s, order: Int64s | None = None) -> Curves:
    """Return the curves of an experiment of these trials.

    ``order`` (agents, trials) says which agent's trial each agent has: its own, unless given.
    """
    drawn = every_trial()[..., trials]
    if order is not None:
        drawn = np.take_along_axis(drawn, order[:, None, None, :], axis=0)
    curves = {
        (agent, design): MeasuredCurve(*drawn[at, place])
        for (at, agent), (place, design) in product(enumerate(AGENTS), enumerate(DESIGNS))
    }
    return cast("Curves", curves)
