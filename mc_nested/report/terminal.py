"""The arena, and what a run knows of it, in a terminal: two columns a cell, coloured, with a legend."""

from collections.abc import Collection

from rich.columns import Columns
from rich.console import Group
from rich.padding import Padding
from rich.text import Text

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import AGENT, BUILT, FREE, MISSING, PARTS, WRONG, kind_of
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.known_arena import KnownArena

OBJECTIVE, OBJECTIVE_NAME = "@", "next"
"""The cell that the agent is after, while nothing is there."""

STYLES = {
    AGENT: "bold white on red",
    BUILT: "black on bright_white",
    WRONG: "black on yellow",
    MISSING: "cyan",
    FREE: "bright_black",
    OBJECTIVE: "bold red",
}

PART_STYLES = ("cyan", "magenta", "green", "yellow")
"""Of the cells to build in the first part, the second, and so on; from the fifth on they come again."""

NAMES = {AGENT: "the agent", BUILT: "built", WRONG: "off the design", MISSING: "still to build"}


def arena_view(
    scenario: Scenario, agent: Cell | None, placed: Collection[Cell], objective: Cell | None = None
) -> Group:
    """Return the arena from above, the far edge on top, and what each sign means."""
    rows = []
    for y in reversed(range(scenario.size)):
        row = Text("  ")
        for x in range(scenario.size):
            kind = kind_of(scenario, agent, placed, (x, y))
            if (x, y) == objective and kind not in (AGENT, BUILT, WRONG):
                kind = OBJECTIVE
            row.append(f"{kind} ", style=style_of(kind))
        rows.append(row)
    legend = Text("  ")
    named = named_signs(len(scenario.parts)) | ({} if objective is None else {OBJECTIVE: OBJECTIVE_NAME})
    for kind, name in named.items():
        legend.append(f" {kind} ", style=style_of(kind))
        legend.append(f" {name}  ", style="default")
    return Group(*rows, legend)


def style_of(kind: str) -> str:
    """Return the style of what is drawn in a cell."""
    return STYLES.get(kind) or PART_STYLES[PARTS.index(kind) % len(PART_STYLES)]


def named_signs(parts: int) -> dict[str, str]:
    """Return what each sign means, in a design of so many parts, 0 if it isn't in parts."""
    if not parts:
        return NAMES
    built = {kind: name for kind, name in NAMES.items() if kind != MISSING}
    return built | {sign: f"part {sign}" for sign in PARTS[:parts]}


BELIEF_SIGNS = {Belief.UNKNOWN: ".", Belief.BELIEVED: "?", Belief.PAYS: "o", Belief.PAYS_NOT: "-"}
BUILT_SIGNS = {True: "#", False: "x"}
"""Signs of a cell built in the last episode: where it is known to pay, and elsewhere."""

MAP_STYLES = {
    ".": "bright_black",
    "?": "black on yellow",
    "o": "black on green",
    "-": "black on bright_black",
    "#": "bold white on green",
    "x": "bold white on red",
}

MAP_NAMES = {"o": "pays", "-": "doesn't", "?": "believed", ".": "unknown", "#": "built, pays", "x": "built elsewhere"}


def belief_rows(known: KnownArena) -> tuple[str, ...]:
    """Return the sign of each cell's belief, a text a row, the nearest row first."""
    size = len(known.cells)
    return tuple("".join(BELIEF_SIGNS[Belief(int(known.cells[x, y]))] for x in range(size)) for y in range(size))


def map_view(known: KnownArena) -> Group:
    """Return what a run knows of its arena, from above, the far edge on top, and what each sign means."""
    size = len(known.cells)
    rows = []
    for y in reversed(range(size)):
        row = Text("  ", no_wrap=True)
        for x in range(size):
            belief = Belief(int(known.cells[x, y]))
            sign = BUILT_SIGNS[belief is Belief.PAYS] if (x, y) in known.built_last else BELIEF_SIGNS[belief]
            row.append(f"{sign} ", style=MAP_STYLES[sign])
        rows.append(row)
    legend = [Text.assemble((f"{sign} ", MAP_STYLES[sign]), name) for sign, name in MAP_NAMES.items()]
    return Group(*rows, Padding(Columns(legend, padding=(0, 2)), (0, 0, 0, 2)))
