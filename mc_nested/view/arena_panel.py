"""The arena from above in a terminal, the far edge on top: what stands, what is believed, and where the agents are."""

from collections.abc import Mapping
from itertools import groupby, product
from operator import itemgetter

from rich.text import Text

from mc_nested.arena.action import Cell
from mc_nested.arena.drawing import AGENT, BUILT, FREE, MISSING, PARTS, WRONG
from mc_nested.report import terminal
from mc_nested.view.status import ArenaSeen, Standing

NOT_KNOWN = "+"
"""A cell of the design that the agent doesn't know of yet."""

MANY = 10
"""So many agents in a cell are drawn as MANY_SIGN."""

MANY_SIGN = "*"

SHADES = "░▒▓█"
"""In a quarter of the trials, a half, three quarters, more."""

BELIEVED: Mapping[str, tuple[str, str]] = {
    "?": ("bold yellow", "believed to pay"),
    "o": (terminal.MAP_STYLES["o"], "known to pay"),
    "-": ("bright_black", "pays nothing"),
    NOT_KNOWN: ("cyan", "not known yet"),
}

AGENT_STYLE = terminal.STYLES[AGENT]


def arena_panel(arena: ArenaSeen, trials: int, width: int, height: int) -> Text:
    """Return the arena, as large as it fits, with what its signs mean below it, where there is room.

    A cell is two columns by a row, or so many times that; in a narrow terminal one column.
    """
    size = arena.size
    wide, high = _scale(size, width, height)
    if size > width:
        return Text(f"the arena needs {size} columns, there are {width}", style="yellow")
    signs = _signs(arena, trials)
    text = Text(no_wrap=True, end="")
    for y in reversed(range(size)):
        row = [signs[x, y] for x in range(size)]
        for line in range(high):
            # One piece for neighbours of one style: a view draws this three times a second.
            for style, cells in groupby(row, key=itemgetter(1)):
                text.append("".join((sign if line == 0 else "").ljust(wide) for sign, _ in cells), style)
            text.append("\n")
    legend = _legend(arena, trials, width)
    if size * high + len(legend) <= height:
        for line_of_legend in legend:
            text.append_text(line_of_legend).append("\n")
    text.right_crop(1)
    return text


def _scale(size: int, width: int, height: int) -> tuple[int, int]:
    """Return columns and rows of a cell."""
    legend = 3
    times = min(width // (2 * size), (height - legend) // size)
    if times >= 1:
        return 2 * times, times
    return (2 if width >= 2 * size else 1), 1


def _signs(arena: ArenaSeen, trials: int) -> dict[Cell, tuple[str, str]]:
    """Return the sign of each cell, and its style."""
    design = set(arena.design)
    stands, agents = _by_cell(arena.stands), _by_cell(arena.agents)
    signs = {}
    for cell in product(range(arena.size), range(arena.size)):
        if cell in agents:
            many = str(agents[cell]) if agents[cell] < MANY else MANY_SIGN
            signs[cell] = AGENT if trials == 1 else many, AGENT_STYLE
        elif cell in stands:
            signs[cell] = _block_sign(stands[cell], trials, cell in design)
        elif cell == arena.objective:
            signs[cell] = terminal.OBJECTIVE, terminal.STYLES[terminal.OBJECTIVE]
        else:
            signs[cell] = _free_sign(arena, cell, cell in design)
    return signs


def _by_cell(standing: tuple[Standing, ...]) -> dict[Cell, int]:
    return {(x, y): count for x, y, count in standing}


def _block_sign(count: int, trials: int, is_right: bool) -> tuple[str, str]:
    kind = BUILT if is_right else WRONG
    if trials == 1:
        return kind, terminal.STYLES[kind]
    shade = SHADES[min(len(SHADES) - 1, count * len(SHADES) // trials)]
    return (shade * 2, "green") if is_right else (shade + WRONG, "yellow")


def _free_sign(arena: ArenaSeen, cell: Cell, is_design: bool) -> tuple[str, str]:
    if not arena.beliefs:
        numbers = (number for number, cells in zip(PARTS, arena.parts, strict=False) if cell in cells)
        kind = next(numbers, MISSING) if is_design else FREE
        return kind, terminal.style_of(kind)
    sign = arena.beliefs[cell[1]][cell[0]]
    if sign in BELIEVED:
        return sign, BELIEVED[sign][0]
    return (NOT_KNOWN, BELIEVED[NOT_KNOWN][0]) if is_design else (FREE, terminal.STYLES[FREE])


def _legend(arena: ArenaSeen, trials: int, width: int) -> list[Text]:
    """Return what the signs mean, in as many lines as it takes."""
    if trials > 1:
        entries = [
            ("1-9", AGENT_STYLE, f"agents, {MANY_SIGN} ten or more"),
            (SHADES, "green", "built, in few to all trials"),
            (f"{SHADES[0]}{WRONG}", "yellow", "off the design"),
        ]
    else:
        entries = [(AGENT, AGENT_STYLE, "agent")]
        entries += [(kind, terminal.STYLES[kind], terminal.NAMES[kind]) for kind in (BUILT, WRONG)]
    if arena.beliefs:
        entries += [(sign, style, name) for sign, (style, name) in BELIEVED.items()]
    else:
        named = terminal.named_signs(len(arena.parts)).items()
        entries += [(sign, terminal.style_of(sign), name) for sign, name in named if sign in MISSING + PARTS]
    if arena.objective:
        entries.append((terminal.OBJECTIVE, terminal.STYLES[terminal.OBJECTIVE], terminal.OBJECTIVE_NAME))
    lines: list[Text] = []
    for sign, style, name in entries:
        entry = Text.assemble((sign, style), f" {name}")
        if lines and len(lines[-1]) + 2 + len(entry) <= width:
            lines[-1].append("  ").append_text(entry)
        else:
            lines.append(entry)
    return lines
