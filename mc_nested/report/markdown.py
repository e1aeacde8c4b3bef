"""Tables and figures of a report, as Markdown."""

from collections.abc import Sequence

from mc_nested.arrays import Float64s
from mc_nested.report.inference import Interval

NONE = "-"


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table; a cell can't break it."""
    lines = [header, ["---"] * len(header), *rows]
    # Users name scenarios, so bars may appear.
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def two(value: float) -> str:
    """With two decimals."""
    return f"{round(value, 2) + 0.0:.2f}"  # + 0.0: no minus before a zero


def mean(trials: Float64s) -> str:
    """The mean over the trials, if there is any."""
    return two(float(trials.mean())) if len(trials) else NONE


def interval(ends: Interval | None) -> str:
    """From where to where."""
    return f"{two(ends.low)} to {two(ends.high)}" if ends else NONE


def probability(p: float | None) -> str:
    """A p-value, if there is one."""
    if p is None:
        return NONE
    if p < 0.00005:
        return "< 0.0001"
    return f"{p:.4f}" if p < 0.99995 else "1"
