"""benchmark.png: the performance profiles, and beside them the episodes on each kind of designs."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import PercentFormatter, StrMethodFormatter

from mc_nested.arena.design import KINDS
from mc_nested.arrays import Float64s, Int64s
from mc_nested.atomic_file import atomic_write
from mc_nested.report.benchmark_measures import profile, profile_band, trials_of
from mc_nested.report.benchmark_results import Benchmark

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito's, distinguishable with any colour vision."""

LINES: Sequence[Any] = ("-", (0, (4, 1.5)), (0, (1, 1.5)))
"""The next line style begins where the colours are used up."""

BAND = 0.15
"""Opacity of the intervals."""

POINTS = 200
"""Numbers of episodes at which profiles are drawn, at most."""

ROOM = 1.2
"""How far a profile goes on after the longest trial, as a factor."""

NEVER = 1.6
"""How far above the longest trial the line stands that says never, as a factor."""


def draw_benchmark(path: Path, benchmark: Benchmark) -> None:
    """Write it as a PNG, atomically; OSError if the disk refuses."""
    styles = {
        name: {"color": COLOURS[place % len(COLOURS)], "linestyle": LINES[place // len(COLOURS) % len(LINES)]}
        for place, name in enumerate(benchmark.most_episodes)
    }
    figure = Figure(figsize=(11.5, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    _draw_profiles(left, benchmark, styles)
    _draw_kinds(right, benchmark, styles)
    for axes in (left, right):
        axes.grid(alpha=0.2)
        axes.spines[["top", "right"]].set_visible(False)
    figure.legend(handles=_legend(styles), loc="outside lower center", ncols=5, frameon=False)
    with atomic_write(path) as unfinished:
        figure.savefig(unfinished, format="png", dpi=140, metadata={"Software": None})


def _draw_profiles(axes: Axes, benchmark: Benchmark, styles: Mapping[str, dict[str, Any]]) -> None:
    most = ROOM * _longest(benchmark)
    episodes: Int64s = np.unique(np.geomspace(1, most, POINTS).astype(np.int64))
    for name, style in styles.items():
        trials = trials_of(benchmark, name)
        band = profile_band(trials, episodes)
        if band:
            axes.fill_between(episodes, *band, color=style["color"], alpha=BAND, linewidth=0, step="post")
        axes.step(episodes, profile(trials.played, episodes), where="post", linewidth=1.7, **style)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.set_xlim(1, most)
    axes.set_ylim(0, 1.02)
    axes.set_title("Trials solved within a number of episodes", loc="left")
    axes.set_xlabel("episodes played, greedy ones included")


def _draw_kinds(axes: Axes, benchmark: Benchmark, styles: Mapping[str, dict[str, Any]]) -> None:
    kinds = [kind for kind in KINDS if any(row.kind == kind for row in benchmark.rows)]
    never = NEVER * _longest(benchmark)
    apart = 0.7 / len(styles)
    for place, kind in enumerate(kinds):
        should: Float64s = np.array([])
        for number, (name, style) in enumerate(styles.items()):
            trials = trials_of(benchmark, name, kind)
            should = trials.without_a_prior
            x = place + apart * (number - (len(styles) - 1) / 2)
            low, middle, high = np.minimum(_quartiles(trials.played), never)
            axes.plot([x, x], [low, high], linewidth=5, alpha=0.35, solid_capstyle="butt", color=style["color"])
            axes.plot([x], [middle], marker="o", markersize=6, color=style["color"], clip_on=False)
        axes.plot([place - 0.42, place + 0.42], [np.median(should)] * 2, color="black", linewidth=1.2)
    axes.axhline(never, color="black", linewidth=0.8, linestyle=(0, (1, 3)))
    axes.set_yscale("log")
    axes.set_ylim(1, never)
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.text(1.0, 1.01, "never solved", transform=axes.transAxes, ha="right", va="bottom", fontsize=9)
    axes.set_xticks(range(len(kinds)), kinds)
    axes.set_xlim(-0.5, len(kinds) - 0.5)
    axes.set_title("Episodes to the optimum: median, middle half", loc="left")
    axes.set_xlabel("how a design's blocks hang together")


def _quartiles(played: Float64s) -> Float64s:
    """The first quartile, the median and the third quartile; an infinite one if its trial is."""
    ordered = np.sort(played, axis=None)
    low, high = (ordered[round(share * (len(ordered) - 1))] for share in (0.25, 0.75))
    return np.array([low, np.median(ordered), high])


def _longest(benchmark: Benchmark) -> int:
    """The most episodes that a trial took to the optimum; at least 10, so that there is an axis."""
    return max([10, *(row.played_to_optimum for row in benchmark.rows if row.played_to_optimum is not None)])


def _legend(styles: Mapping[str, dict[str, Any]]) -> list[Line2D]:
    shown: dict[str, Any] = {"linewidth": 1.7, "marker": "o", "markersize": 5}
    return [
        *(Line2D([], [], label=name, **shown, **style) for name, style in styles.items()),
        Line2D([], [], color="black", linewidth=1.2, label="without a prior, in theory"),
    ]
