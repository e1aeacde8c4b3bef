"""ablation.md: a table for each scenario, a line for each part that is off."""

from collections.abc import Sequence

import numpy as np

from mc_nested.report.ablation_results import Ablation, AblationPart, PartMeasures, measures_on
from mc_nested.report.inference import Interval

HEADER = (
    "what is off",
    "what that means",
    "solved",
    "median (95 %)",
    "worst",
    "best score",
    "updates, median",
    "given up after",
)

WHAT_LIVE_IS = """\
The preset `live` is double Q-learning alone: there is no imitation in it, of its own episodes or of anybody's. The
first line has all of its parts, and each of the next ones is without one, or with another value. `tuned` is the
model-free preset, which has no learnt game: excursions find the build, and it imitates its best episode. The planner
has no network at all: a script explores, and builds on what it found; how to move and where blocks land it knows."""

LEGEND = """\
Solved: trials with a greedy episode at the optimum. Median and worst: real episodes played until then, that one and the
other greedy ones included; a trial that was never there counts as infinite (∞). The interval is a percentile bootstrap
of the median over the trials; with few trials it is too narrow. Best score: the highest of any greedy episode. Updates:
of all networks of a trial until it was solved or given up. Given up after: that many training episodes."""


def ablation_text(ablation: Ablation) -> str:
    """The tables as Markdown; the same rows give the same text."""
    trials = f"{ablation.trials} trials" if ablation.trials > 1 else "one trial"
    parts = [
        "# What each part of the learning does",
        f"Real episodes to the optimum: {trials} of each line on each design, seed {ablation.seed}.",
        WHAT_LIVE_IS.replace("\n", " "),
        "![Episodes to the optimum, a panel for each design, a line for each part](ablation.png)",
        *(
            f"## {scenario}, optimum {optimum:g}\n\n{_table(measures_on(ablation, scenario))}"
            for scenario, optimum in ablation.optimum.items()
        ),
        LEGEND.replace("\n", " "),
    ]
    return "\n\n".join(parts) + "\n"


def _table(found: Sequence[tuple[AblationPart, PartMeasures]]) -> str:
    lines = [HEADER, ["---"] * len(HEADER), *(_line(part, measures) for part, measures in found)]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def _line(part: AblationPart, measures: PartMeasures) -> Sequence[str]:
    return (
        part.name,
        part.what,
        f"{measures.solved} of {len(measures.played)}",
        f"{_episodes(measures.median)}{_interval(measures.interval)}",
        _episodes(measures.worst),
        f"{measures.best_score:g}",
        f"{measures.updates:,.0f}",
        f"{part.most_episodes:,}",
    )


def _interval(interval: Interval | None) -> str:
    if interval is None or not np.isfinite(interval.low):
        return ""
    return f" ({_episodes(interval.low)} to {_episodes(interval.high)})"


def _episodes(number: float) -> str:
    return f"{number:,g}" if np.isfinite(number) else "∞"
