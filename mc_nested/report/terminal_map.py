"""What a run knows of its arena, in a terminal: two columns a cell, coloured, with a legend."""

from rich.columns import Columns
from rich.console import Group
from rich.padding import Padding
from rich.text import Text

from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.known_arena import KnownArena

SIGNS = {Belief.UNKNOWN: ".", Belief.BELIEVED: "?", Belief.PAYS: "o", Belief.PAYS_NOT: "-"}
BUILT_SIGNS = {True: "#", False: "x"}
"""Signs of a cell built in the last episode: where it is known to pay, and elsewhere."""

STYLES = {
    ".": "bright_black",
    "?": "black on yellow",
    "o": "black on green",
    "-": "black on bright_black",
    "#": "bold white on green",
    "x": "bold white on red",
}

NAMES = {"o": "pays", "-": "doesn't", "?": "believed", ".": "unknown", "#": "built, pays", "x": "built elsewhere"}


def belief_rows(known: KnownArena) -> tuple[str, ...]:
    """Return the sign of each cell's belief, a text a row, the nearest row first."""
    size = len(known.cells)
    return tuple("".join(SIGNS[Belief(int(known.cells[x, y]))] for x in range(size)) for y in range(size))


def map_view(known: KnownArena) -> Group:
    """Return the arena from above, the far edge on top, and what each sign means."""
    size = len(known.cells)
    rows = []
    for y in reversed(range(size)):
        row = Text("  ", no_wrap=True)
        for x in range(size):
            belief = Belief(int(known.cells[x, y]))
            sign = BUILT_SIGNS[belief is Belief.PAYS] if (x, y) in known.built_last else SIGNS[belief]
            row.append(f"{sign} ", style=STYLES[sign])
        rows.append(row)
    legend = [Text.assemble((f"{sign} ", STYLES[sign]), name) for sign, name in NAMES.items()]
    return Group(*rows, Padding(Columns(legend, padding=(0, 2)), (0, 0, 0, 2)))
