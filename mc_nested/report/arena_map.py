"""A picture of what a run knows of its arena, and of where the blocks of its real episodes went."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.known_arena import KnownArena

COLORS = {Belief.UNKNOWN: "#ececec", Belief.BELIEVED: "#f2d16b", Belief.PAYS: "#3a7d44", Belief.PAYS_NOT: "#9aa5b1"}

NAMES = {
    Belief.UNKNOWN: "unknown",
    Belief.BELIEVED: "believed to pay",
    Belief.PAYS: "known to pay",
    Belief.PAYS_NOT: "known not to pay",
}

BUILT = "#14213d"

SPENDING = {
    "built": ("#3a7d44", "built where it was known to pay"),
    "new_paid": ("#f2a541", "a new cell tried: it pays"),
    "new_not": ("#9aa5b1", "a new cell tried: it doesn't"),
    "other": ("#5c4d7d", "other"),
}


def draw_map(path: Path, title: str, known: KnownArena) -> None:
    """Write a PNG: the arena from above, the far edge on top, and beside it a bar for each remembered episode."""
    figure = Figure(figsize=(12, 6.2), dpi=120, layout="constrained")
    arena, episodes = figure.subplots(1, 2)
    figure.suptitle(title, parse_math=False)  # users name scenarios, so dollar signs may appear
    _draw_arena(arena, known)
    _draw_episodes(episodes, known)
    figure.savefig(path, format="png", metadata={"Software": None})


def _draw_arena(axes: Axes, known: KnownArena) -> None:
    size = len(known.cells)
    axes.imshow(
        known.cells.T,
        cmap=ListedColormap([COLORS[belief] for belief in Belief]),
        vmin=-0.5,
        vmax=len(Belief) - 0.5,
        origin="lower",
    )
    axes.set_xticks(np.arange(-0.5, size), minor=True)
    axes.set_yticks(np.arange(-0.5, size), minor=True)
    axes.grid(which="minor", color="white", linewidth=1.0)
    axes.tick_params(which="minor", length=0)
    if known.built_last:
        across, forward = zip(*sorted(known.built_last), strict=True)
        axes.scatter(across, forward, marker="s", s=3600 / size, facecolors="none", edgecolors=BUILT, linewidths=2)
    axes.set(xlabel="x", ylabel="y", title=f"{known.known_to_pay} cells known to pay")
    legend: list[Patch | Line2D] = [Patch(color=COLORS[belief], label=NAMES[belief]) for belief in Belief]
    legend.append(
        Line2D([], [], color=BUILT, marker="s", fillstyle="none", linestyle="", label="built in the last episode")
    )
    axes.legend(handles=legend, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, frameon=False)


def _draw_episodes(axes: Axes, known: KnownArena) -> None:
    numbers = [blocks.episode for blocks in known.episodes]
    heights = {
        "built": [blocks.built for blocks in known.episodes],
        "new_paid": [blocks.new_paid for blocks in known.episodes],
        "new_not": [blocks.new - blocks.new_paid for blocks in known.episodes],
        "other": [blocks.other for blocks in known.episodes],
    }
    below = np.zeros(len(numbers))
    for name, (color, label) in SPENDING.items():
        axes.bar(numbers, heights[name], bottom=below, color=color, label=label)
        below += heights[name]
    probing = sum(blocks.probes for blocks in known.episodes)
    building = sum(blocks.built > 0 and not blocks.probes for blocks in known.episodes)
    axes.set(
        xlabel="real episode",
        ylabel="blocks",
        title=f"of {len(numbers)} episodes {probing} tried new cells, {building} only built",
    )
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, frameon=False)
