"""The arena in a terminal: two columns a cell, coloured, with a legend."""

from collections.abc import Collection

from rich.console import Group
from rich.text import Text

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import AGENT, BUILT, FREE, MISSING, WRONG, kind_of
from mc_nested.arena.scenario import Scenario

STYLES = {
    AGENT: "bold white on red",
    BUILT: "black on bright_white",
    WRONG: "black on yellow",
    MISSING: "cyan",
    FREE: "bright_black",
}

NAMES = {AGENT: "the agent", BUILT: "built", WRONG: "off the design", MISSING: "still to build"}


def arena_view(scenario: Scenario, agent: Cell | None, placed: Collection[Cell]) -> Group:
    """The arena from above, the far edge on top, and what each sign means."""
    rows = []
    for y in reversed(range(scenario.size)):
        row = Text("  ")
        for x in range(scenario.size):
            kind = kind_of(scenario, agent, placed, (x, y))
            row.append(f"{kind} ", style=STYLES[kind])
        rows.append(row)
    legend = Text("  ")
    for kind, name in NAMES.items():
        legend.append(f" {kind} ", style=STYLES[kind])
        legend.append(f" {name}  ", style="default")
    return Group(*rows, legend)
