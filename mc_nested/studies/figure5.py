"""The paper's Figure 5: a panel for each scenario, greedy score against training episode, a curve for each agent."""

from collections.abc import Mapping
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator, StrMethodFormatter

from mc_nested.report.curve import t_interval
from mc_nested.studies.results import Curve, Results

CURVES: dict[str, dict[str, Any]] = {
    "nested": {"color": "#0072B2", "linestyle": "-"},
    "hierarchical": {"color": "#D55E00", "linestyle": "-"},
    "single": {"color": "#009E73", "linestyle": (0, (4, 1.2))},
}
"""Okabe and Ito's colours, distinguishable with any colour vision."""

OPTIMUM: dict[str, Any] = {"color": "black", "linewidth": 0.8}
BUILDER: dict[str, Any] = {"color": "black", "linewidth": 2.6, "linestyle": (0, (1, 4))}
"""Wide dots, so that the line is visible even if the builder's score is the optimum."""

BAND = 0.18
"""Opacity of the intervals."""

COLUMNS = 3


def figure5(results: Results) -> Figure:
    """Draw it; the same results give the same bytes with the same matplotlib."""
    columns = min(COLUMNS, len(results.scenarios))
    rows = -(-len(results.scenarios) // columns)
    figure = Figure(figsize=(max(6.0, 4.3 * columns), 3.8 * rows + 0.5), dpi=160, layout="constrained")
    panels = list(figure.subplots(rows, columns, sharey=True, squeeze=False).flat)
    for axes, scenario in zip(panels, results.scenarios, strict=False):
        axes.axhline(results.optimum[scenario], zorder=1, **OPTIMUM)
        axes.axhline(results.builder[scenario], zorder=1, **BUILDER)
        for agent in results.agents:
            draw_curve(axes, results.curves[agent, scenario], results.optimum[scenario], CURVES[agent])
        axes.set_title(scenario, parse_math=False)  # users name scenarios, so dollar signs may appear
        axes.set_xlabel("training episodes")
        axes.set_xlim(0, results.episodes)
        axes.xaxis.set_major_locator(MaxNLocator(3, integer=True))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(alpha=0.2)
        axes.spines[["top", "right"]].set_visible(False)
    for first in panels[::columns]:
        first.set_ylabel("score of a greedy episode")
    for unused in panels[len(results.scenarios) :]:
        unused.remove()
    figure.legend(handles=_legend(results), loc="outside lower center", ncols=2 * columns, frameon=False)
    return figure


def draw_curve(axes: Axes, curve: Curve, optimum: float, look: Mapping[str, Any], label: str | None = None) -> None:
    """Draw the mean over the trials with its interval; nothing where there was no evaluation."""
    if not len(curve.episodes):
        return
    if len(curve.scores) > 1:
        low, high = t_interval(curve.scores, optimum)
        axes.fill_between(curve.episodes, low, high, color=look["color"], alpha=BAND, linewidth=0)
    marker = "o" if len(curve.episodes) == 1 else ""
    axes.plot(curve.episodes, curve.scores.mean(axis=0), marker=marker, linewidth=1.5, label=label, **look)


def _legend(results: Results) -> list[Artist]:
    of = f"mean of {results.trials} trials" if results.trials > 1 else "one trial"
    curves: list[Artist] = [
        Line2D([], [], linewidth=1.5, label=f"{agent}, {of}", **CURVES[agent]) for agent in results.agents
    ]
    band = [Patch(color="black", alpha=BAND, linewidth=0, label="95 % interval")] if results.trials > 1 else []
    optimum = Line2D([], [], label="optimum", **OPTIMUM)
    builder = Line2D([], [], label="scripted builder", **BUILDER)
    return [*curves, *band, optimum, builder]
