"""beyond.png: a panel for each design seen as an image, and one each for parts, many main actions and cooperation.

objectives.png: scores and parameters against the number of main actions.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mc_nested.arrays import Float64s
from mc_nested.learn.builders import NETWORKS
from mc_nested.report.curve import t_interval
from mc_nested.studies.claims.arm_results import ArmResults, Arms
from mc_nested.studies.claims.beyond import alone_among, equal_budget, of_topic, teams_of
from mc_nested.studies.reproduce import CURVES, OPTIMUM, draw_curve
from mc_nested.studies.results import curve_of
from mc_nested.studies.table import number_of_trials

COLUMNS = 3
CURVE_PANELS = 4
"""Panels of scores against episodes: three of images, one of parts. The other panels show means."""

LOOKS: Mapping[str, Mapping[str, Any]] = {
    **CURVES,
    "nested, tuned": {"color": "#56B4E9", "linestyle": "-."},
    "images": {"color": "#0072B2", "linestyle": "-"},
    "numbers": {"color": "#E69F00", "linestyle": (0, (4, 1.2))},
    "shared": {"color": "#0072B2", "linestyle": "-"},
    "own": {"color": "#CC79A7", "linestyle": "-"},
    "alone": {"color": "black", "linestyle": "-"},
}
"""Okabe and Ito's colours; the same agent looks the same as in Figure 5."""


def beyond_figure(arms: Arms) -> Figure:
    """Draw it; the same results give the same bytes."""
    images = of_topic(arms, "images")
    figure = Figure(figsize=(13.0, 8.2), dpi=140, layout="constrained")
    panels = list(figure.subplots(2, COLUMNS).flat)
    for axes, design in zip(panels, dict.fromkeys(arm.scenario for arm in images), strict=False):
        _draw_curves(axes, [arm for arm in images if arm.scenario == design], f"{design}: images and numbers")
    parts = of_topic(arms, "parts")
    _draw_curves(panels[3], parts, f"{parts[0].scenario}: a material for each part")
    _draw_main_actions(panels[4], of_topic(arms, "materials"), "materials")
    _draw_teams(panels[5], of_topic(arms, "cooperation"))
    for at, axes in enumerate(panels):
        _finish(axes, "lower right" if at < CURVE_PANELS else "lower left")  # curves rise to the right, means fall
    return figure


def objectives_figure(arms: Arms) -> Figure:
    """Draw it; the same results give the same bytes."""
    own = of_topic(arms, "objectives")
    figure = Figure(figsize=(11.0, 4.4), dpi=140, layout="constrained")
    scores, parameters = figure.subplots(1, 2)
    _draw_main_actions(scores, own, "objectives")
    for agent in CURVES:
        of_agent = [arm for arm in own if arm.name == agent]
        needed = [arm.trials[0].parameters for arm in of_agent]
        parameters.plot(
            [arm.materials for arm in of_agent], needed, marker="o", markersize=4, label=agent, **LOOKS[agent]
        )
    _mark_main_actions(parameters, own)
    parameters.set_yscale("log")
    parameters.set(title="what a trial trains", xlabel="objectives", ylabel="parameters of all its networks")
    _finish(scores, "lower left")
    _finish(parameters, "upper left")
    return figure


def _finish(axes: Axes, corner: Literal["lower left", "lower right", "upper left"]) -> None:
    axes.grid(alpha=0.2)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=8, loc=corner)


def _draw_curves(axes: Axes, arms: Sequence[ArmResults], title: str) -> None:
    optimum, lowest = arms[0].optimum, 0.0
    axes.axhline(optimum, zorder=1, **OPTIMUM)
    for arm in arms:
        curve, ends = curve_of(arm.trials), ", each until the optimum" if arm.stops else ""
        lowest = min(lowest, float(curve.scores.mean(axis=0).min()))
        label = f"{arm.name}, {number_of_trials(len(arm.trials))}{ends}"
        draw_curve(axes, curve, optimum, LOOKS[arm.name], label)
    axes.set_ylim(1.1 * lowest, 1.1 * optimum)
    axes.set(title=title, xlabel="training episodes", ylabel="score of a greedy episode")


def _draw_main_actions(axes: Axes, own: Sequence[ArmResults], what: str) -> None:
    budget, optimum = equal_budget(own, "steps"), own[0].optimum
    axes.axhline(own[0].optimum, zorder=1, **OPTIMUM)
    for number, agent in enumerate(CURVES):
        of_agent = [arm for arm in own if arm.name == agent]
        counts = [arm.materials * 1.04 ** (number - 1) for arm in of_agent]
        _draw_means(axes, counts, [arm.within(budget, "steps") for arm in of_agent], optimum, agent, agent)
    _mark_main_actions(axes, own)
    axes.set(title=f"main actions, after {budget:,} steps", xlabel=what, ylabel="mean of the last ten")


def _mark_main_actions(axes: Axes, own: Sequence[ArmResults]) -> None:
    axes.set_xscale("log", base=2)
    counts = sorted({arm.materials for arm in own})
    axes.set_xticks(counts, [str(count) for count in counts])


def _draw_teams(axes: Axes, own: Sequence[ArmResults]) -> None:
    axes.axhline(own[0].optimum, zorder=1, **OPTIMUM)
    alone = alone_among(own)
    _draw_means(axes, [1.0], [alone.last_ten], alone.optimum, "alone", "1 builder")
    for number, kind in enumerate(NETWORKS):
        teams = teams_of(own, kind)
        counts = [count + 0.06 * (number - 1) for count in teams]
        _draw_means(axes, counts, [arm.last_ten for arm in teams.values()], alone.optimum, kind, f"networks: {kind}")
    axes.set_xticks(sorted({arm.arm.builders for arm in own if arm.arm.builders}))
    title = f"{alone.scenario}: builders in one arena"
    axes.set(title=title, xlabel="builders", ylabel="mean of the last ten")


def _draw_means(
    axes: Axes, at: Sequence[float], trials: Sequence[Float64s], optimum: float, look: str, label: str
) -> None:
    means = [float(own.mean()) for own in trials]
    if len(trials[0]) > 1:
        ends = [t_interval(own[:, None], optimum) for own in trials]
        below = [mean - float(low[0]) for mean, (low, _) in zip(means, ends, strict=True)]
        errors = np.array([below, [float(high[0]) - mean for mean, (_, high) in zip(means, ends, strict=True)]])
    else:
        errors = np.zeros((2, len(means)))
    axes.errorbar(at, means, yerr=errors, marker="o", markersize=4, capsize=3, label=label, **LOOKS[look])
