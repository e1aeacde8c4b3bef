"""A table of a report: as CSV, as Markdown, and its cells in words."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.atomic_file import atomic_write
from mc_nested.studies.inference import Interval, coverage, mean_interval, share_interval

NONE = "-"


@dataclass(frozen=True)
class Table:
    """Rows of cells below a header."""

    header: Sequence[str]
    rows: Sequence[Sequence[Any]]

    def write(self, path: Path) -> None:
        """Write the table as CSV, atomically; OSError if the disk refuses."""
        with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(self.header)
            writer.writerows(self.rows)


def table_of(rows: Sequence[Mapping[str, Any]]) -> Table:
    """Return the table of these rows, one at least, whose cells are by their columns' headings."""
    return Table(list(rows[0]), [list(row.values()) for row in rows])


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return the table as Markdown; a cell can't break it."""
    lines = [header, ["---"] * len(header), *rows]
    # Users name scenarios, so bars may appear.
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


Cells = Sequence[tuple[str, str]]
"""A row: each cell behind its column's heading."""


def markdown_of(rows: Sequence[Cells]) -> str:
    """Return as Markdown the table of these rows, which have the same headings; nothing where there is no row."""
    cells = [[cell for _, cell in row] for row in rows]
    return markdown([heading for heading, _ in rows[0]], cells) if rows else ""


def two(value: float) -> str:
    """Write a number with two decimals."""
    return f"{round(value, 2) + 0.0:.2f}"  # + 0.0: no minus before a zero


def mean(trials: Float64s) -> str:
    """Return the mean over the trials, if there is any."""
    return two(float(trials.mean())) if len(trials) else NONE


def interval(ends: Interval | None, held: float | None = None) -> str:
    """Write an interval as its two ends, and how often such a one holds the mean, if that is known."""
    written = f"{two(ends.low)} to {two(ends.high)}" if ends else NONE
    return f"{written} (held {100 * held:.0f} %)" if ends and held is not None and ends.low < ends.high else written


def interval_of_mean(trials: Float64s, highest: float) -> str:
    """Write the interval of the mean over the trials (trials,), or how many are at ``highest`` where half are."""
    if len(trials) > 1 and 2 * (at_highest := int((trials >= highest).sum())) >= len(trials):
        share = interval(share_interval(at_highest, len(trials)))
        return f"{at_highest} of {len(trials)} at {highest:g}, share {share}"
    found = mean_interval(trials, highest)
    return interval(found, float(coverage(trials[:, None], highest)[0]) if found else None)


def probability(p: float | None) -> str:
    """Return a p-value, if there is one."""
    if p is None:
        return NONE
    if p < 0.00005:
        return "< 0.0001"
    return f"{p:.4f}" if p < 0.99995 else "1"


def number_of_trials(trials: int) -> str:
    """Return ``one trial``, ``2 trials``."""
    return f"{trials} trials" if trials > 1 else "one trial"


def episodes(number: float) -> str:
    """Write a number of episodes to a tenth, or to a whole number from 100 on; ∞ for never."""
    if not np.isfinite(number):
        return "∞"
    return f"{number:,.0f}" if number >= 100 or number == int(number) else f"{number:.1f}"
