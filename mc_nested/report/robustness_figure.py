"""robustness.png: a grid of verdicts, a line for each choice and a column for each claim."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from mc_nested.atomic_file import atomic_write
from mc_nested.report.robustness_results import JudgedChoice
from mc_nested.report.verdicts import Verdict

LOOKS = {
    Verdict.HOLDS: ("#009E73", "✓"),
    Verdict.FAILS: ("#D55E00", "✗"),
    Verdict.UNDECIDED: ("#DDDDDD", ""),
    Verdict.NOT_RUN: ("white", ""),
}
"""Okabe and Ito's colours, and a sign for whoever can't tell them apart."""


def draw_robustness(path: Path, choices: Sequence[JudgedChoice]) -> None:
    """Write it as a PNG, atomically; OSError if the disk refuses. The base is the line on top."""
    letters = list(choices[0].verdicts)
    figure = Figure(figsize=(3.6 + 0.5 * len(letters), 1.6 + 0.3 * len(choices)), layout="constrained")
    axes = figure.subplots()
    for row, each in enumerate(choices):
        for column, letter in enumerate(letters):
            _draw_cell(axes, column, row, each.verdicts[letter])
    axes.set_xlim(-0.5, len(letters) - 0.5)
    axes.set_ylim(len(choices) - 0.5, -0.5)
    axes.set_xticks(range(len(letters)), [f"({letter})" for letter in letters])
    axes.set_yticks(range(len(choices)), [each.name for each in choices], parse_math=False)
    axes.axhline(0.5, color="black", linewidth=1.4)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    legend = [Patch(facecolor=LOOKS[verdict][0], edgecolor="grey", label=verdict.value) for verdict in LOOKS]
    figure.legend(handles=legend, loc="outside lower center", ncols=len(legend), frameon=False)
    with atomic_write(path) as unfinished:
        figure.savefig(unfinished, format="png", dpi=140, metadata={"Software": None})


def _draw_cell(axes: Axes, column: int, row: int, verdict: Verdict) -> None:
    color, sign = LOOKS[verdict]
    axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=color, edgecolor="white", linewidth=1.5))
    axes.text(column, row, sign, ha="center", va="center", fontsize=9)
