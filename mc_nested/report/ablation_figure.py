"""ablation.png: a panel for each scenario, a line for each part that is off, a mark for each trial and its median."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from mc_nested.atomic_file import atomic_write
from mc_nested.report.ablation_results import Ablation, AblationPart, PartMeasures, measures_on

TRIAL, MEDIAN, WITHOUT = "#56B4E9", "#0072B2", "#D55E00"
"""Okabe and Ito's colours, distinguishable with any colour vision: a trial, a median, and a median of never."""

NEVER = 1.8
"""How far beyond the longest trial the line stands that says never, as a factor."""

SPREAD = 0.28
"""How far the trials of a line lie apart from its middle at most, in lines."""


def draw_ablation(path: Path, ablation: Ablation) -> None:
    """Write it as a PNG, atomically; OSError if the disk refuses."""
    panels, lines = len(ablation.optimum), len(ablation.parts)
    figure = Figure(figsize=(3.0 + 3.2 * panels, 1.6 + 0.34 * lines), layout="constrained")
    every_axes = figure.subplots(1, panels, sharey=True, squeeze=False)[0]
    never = NEVER * max([10, *(row.played_to_optimum or 0 for row in ablation.rows)])
    for axes, scenario in zip(every_axes, ablation.optimum, strict=True):
        _draw(axes, measures_on(ablation, scenario), never)
        axes.set_title(scenario, parse_math=False, fontsize=10)  # users name scenarios: dollar signs may appear
        axes.set_xlabel("real episodes to the optimum")
    every_axes[0].set_yticks(range(lines), [part.name for part in ablation.parts])
    every_axes[0].set_ylim(lines - 0.5, -0.5)
    figure.legend(handles=_legend(), loc="outside lower center", ncols=3, frameon=False)
    with atomic_write(path) as unfinished:
        figure.savefig(unfinished, format="png", dpi=140, metadata={"Software": None})


def _draw(axes: Axes, found: Sequence[tuple[AblationPart, PartMeasures]], never: float) -> None:
    for line, (part, measures) in enumerate(found):
        if line and part.base != found[line - 1][0].base:
            axes.axhline(line - 0.5, color="black", linewidth=0.6)
        count = len(measures.played)
        heights = line + (np.linspace(-SPREAD, SPREAD, count) if count > 1 else np.zeros(1))
        shown = np.minimum(np.sort(measures.played), never)
        axes.plot(shown, heights, "o", markersize=4, color=TRIAL, markeredgewidth=0, clip_on=False)
        solved = np.isfinite(measures.median)
        median = min(measures.median, never)
        colour = MEDIAN if solved else WITHOUT
        axes.plot([median] * 2, [line - 0.36, line + 0.36], color=colour, linewidth=2.4, clip_on=False)
        label = f"{measures.median:,g}" if solved else "∞"
        on_the_left = median > never / 3
        beside: dict[str, Any] = {"xytext": (-5 if on_the_left else 5, 0), "ha": "right" if on_the_left else "left"}
        axes.annotate(label, (median, line), textcoords="offset points", fontsize=8, va="center", **beside)
    axes.axvline(never, color="black", linewidth=0.8, linestyle=(0, (1, 3)))
    axes.text(never, 1.005, "never", transform=axes.get_xaxis_transform(), ha="right", va="bottom", fontsize=8)
    axes.set_xscale("log")
    axes.set_xlim(1, never)
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(axis="x", alpha=0.2)
    axes.tick_params(left=False)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _legend() -> list[Line2D]:
    return [
        Line2D([], [], color=TRIAL, marker="o", markersize=4, linestyle="", label="a trial"),
        Line2D([], [], color=MEDIAN, marker="|", markersize=11, markeredgewidth=2.4, linestyle="", label="the median"),
        Line2D(
            [], [], color=WITHOUT, marker="|", markersize=11, markeredgewidth=2.4, linestyle="", label="median: never"
        ),
    ]
