"""sweep.png: a panel for each scenario, a line for each variant, how far its scores are from the base's."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mc_nested.atomic_file import atomic_write
from mc_nested.report.inference import Interval
from mc_nested.report.sweep_results import Effect, Sweep, effects_on

FINAL, MEAN = "#0072B2", "#E69F00"
"""Okabe and Ito's colours, distinguishable with any colour vision."""

APART = 0.17
"""Between the two marks of a line, in lines."""


def draw_sweep(path: Path, sweep: Sweep) -> None:
    """Write it as a PNG, atomically; OSError if the disk refuses."""
    effects = {
        scenario: [effect for effect in effects_on(sweep, scenario) if effect.choice] for scenario in sweep.optimum
    }
    lines = max((len(own) for own in effects.values()), default=0)
    figure = Figure(figsize=(3.4 + 3.2 * len(effects), 1.6 + 0.3 * lines), layout="constrained")
    panels = figure.subplots(1, len(effects), sharey=True, squeeze=False)[0]
    for axes, (scenario, own) in zip(panels, effects.items(), strict=True):
        _draw(axes, own)
        base = next(effect for effect in effects_on(sweep, scenario) if not effect.choice)
        title = f"{scenario}\nbase {base.final:.1f}, mean {base.mean:.1f} of {sweep.optimum[scenario]:g}"
        axes.set_title(title, parse_math=False, fontsize=10)  # users name scenarios, so dollar signs may appear
        axes.set_xlabel("score above the base")
    panels[0].set_yticks(range(lines), [f"{effect.choice}: {effect.value}" for effect in next(iter(effects.values()))])
    panels[0].set_ylim(lines - 0.5, -0.5)
    figure.legend(handles=_legend(), loc="outside lower center", ncols=2, frameon=False)
    with atomic_write(path) as unfinished:
        figure.savefig(unfinished, format="png", dpi=140, metadata={"Software": None})


def _draw(axes: Axes, effects: Sequence[Effect]) -> None:
    axes.axvline(0, color="black", linewidth=0.8, zorder=1)
    for line, effect in enumerate(effects):
        _mark(axes, line - APART, effect.final_difference, effect.final_interval, FINAL, "o")
        _mark(axes, line + APART, effect.mean_difference, effect.mean_interval, MEAN, "D")
    axes.grid(axis="x", alpha=0.2)
    axes.tick_params(left=False)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _mark(axes: Axes, line: float, difference: float, interval: Interval | None, color: str, marker: str) -> None:
    if interval:
        axes.plot([interval.low, interval.high], [line, line], color=color, linewidth=1.4, zorder=2)
    # Filled where the interval leaves out 0.
    clear = interval is not None and (interval.low > 0 or interval.high < 0)
    axes.plot(
        [difference],
        [line],
        marker=marker,
        markersize=4.5,
        color=color,
        markerfacecolor=color if clear else "white",
        zorder=3,
    )


def _legend() -> list[Line2D]:
    return [
        Line2D([], [], color=FINAL, marker="o", markersize=4.5, label="final score"),
        Line2D(
            [],
            [],
            color=MEAN,
            marker="D",
            markersize=4.5,
            label="mean over the training; lines: 95 % intervals, filled: 0 is outside",
        ),
    ]
