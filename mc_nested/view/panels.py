"""The parts of the view, each from a status to text: title, status line, arena, side, and where in time it is.

Beside the arena are the training's progress, its curve, the reading, the last actions and what the run said. Where
there is no terminal to draw in, the view is lines of text.
"""

from collections.abc import Sequence

import numpy as np
from rich.text import Text

from mc_nested.view.arena_panel import arena_panel
from mc_nested.view.status import ActionSeen, Learning, ReadingSeen, Status
from mc_nested.view.words import StatusShown, clock_time, learning_lines, status_words, wrapped

WIDEST = 3
"""Columns of an episode, while there are few."""

EIGHTHS = " ▁▂▃▄▅▆▇█"


def curve_panel(scores: Sequence[float], highest: float, width: int, height: int) -> Text:
    """Draw the scores from 0 to the highest one, up to three columns each, or a column for the mean of several."""
    text = Text(no_wrap=True, end="")
    if not scores or width < 1 or height < 1:
        return text
    columns = [float(part.mean()) for part in np.array_split(scores, min(width, len(scores)))]
    columns = list(np.repeat(columns, min(WIDEST, width // len(columns))))
    top = max(highest, 1e-9)
    levels = [round(min(max(score / top, 0.0), 1.0) * height * 8) for score in columns]
    for row in reversed(range(height)):
        text.append("".join(EIGHTHS[min(8, max(0, level - 8 * row))] for level in levels), "green")
        text.append("\n")
    text.right_crop(1)
    return text


HEAD = "bold"
MOST_CURVE = 8
LEAST_ACTIONS = 3
MS = 1000


def side_panel(status: Status, width: int, height: int) -> Text:
    """Return the side panel in so many lines.

    Where they don't suffice, the curve and the oldest actions are left out.
    """
    learning = status.learning
    head = [Text(line) for line in learning_lines(learning)] if learning else []
    reading = _reading(status.reading)
    said = _said(status.lines, width)
    fixed = len(head) + len(reading) + len(said)
    wanted = min(len(status.actions), LEAST_ACTIONS) + bool(status.actions)
    curve = _curve(learning, width, height - fixed - wanted) if learning else []
    room = height - fixed - len(curve)
    actions = _actions(status.actions, status.share, room)
    lines = [*head, *curve, *reading, *actions, *said][: max(0, height)]
    for line in lines:
        line.truncate(width, overflow="ellipsis")
    return Text("\n", end="").join(lines)


def _curve(learning: Learning, width: int, room: int) -> list[Text]:
    """Return the curve below a heading, in at most so many lines."""
    high = min(MOST_CURVE, room - 1)
    if not learning.scores or high < 1:
        return []
    head = Text(f"score by episode, from 0 to {learning.optimum:.4g}", HEAD)
    return [head, *curve_panel(learning.scores, learning.optimum, width, high).split("\n")]


def _reading(reading: ReadingSeen | None) -> list[Text]:
    if reading is None:
        return []
    if reading.problem is not None:
        return [Text("the debug screen", HEAD), Text(reading.problem, "red")]
    lines = [Text("the debug screen", HEAD)]
    if reading.position is not None:
        x, y, z = reading.position
        facing = "" if reading.yaw is None or reading.pitch is None else f"  {reading.yaw:.1f} / {reading.pitch:.1f}"
        lines.append(Text(f"at {x:.3f} {y:.3f} {z:.3f}{facing}"))
    lines.append(Text(f"looks at {reading.target or 'no block'}"))
    return lines


def _actions(actions: tuple[ActionSeen, ...], share: str, room: int) -> list[Text]:
    if not actions or room < 2:
        return []
    shares = [Text(share)] if share and room > LEAST_ACTIONS + 1 else []
    return [
        Text("last actions: time, where to, block", HEAD),
        *shares,
        *(_action(action) for action in reversed(actions[-(room - 1 - len(shares)) :])),
    ]


def _action(action: ActionSeen) -> Text:
    seconds = "" if action.seconds is None else f"{action.seconds * MS:.0f} ms "
    placed = f", block {_cell(action.placed)}" if action.placed else ""
    return Text(f"{seconds}{action.name:<3} {_cell(action.cell)}{placed}")


def _cell(cell: tuple[int, int]) -> str:
    return f"({cell[0]}, {cell[1]})"


def _said(lines: tuple[str, ...], width: int) -> list[Text]:
    """Return the last lines, whole: an instruction must not be cut off."""
    if not lines:
        return []
    whole = [Text(part) for line in lines[-3:] for part in wrapped(line, width)]
    return [Text("it said", HEAD), *whole[-6:]]


SIGNS = {
    "works": ("▶", "bold green"),
    "plays": ("▶", "bold green"),
    "player": ("◆", "bold cyan"),
    "waits": ("…", "bold yellow"),
    "asks": ("?", "bold yellow"),
    "paused": ("‖", "bold yellow"),
    "stops": ("■", "bold yellow"),
    "fails": ("!", "bold red"),
    "stuck": ("!", "bold red"),
    "gone": ("✗", "bold red"),
    "ended": ("✓", "bold blue"),
}
"""A sign for how the run goes, and its style: the sign is there without colours, too."""


INDENT = 2
"""Columns of the sign, below which the sentence goes on."""


def title(shown: StatusShown, width: int, _height: int) -> Text:
    """Return what is done, in a line."""
    text = Text(f"{shown.status.what}: {shown.status.title}", "bold", no_wrap=True)
    text.truncate(width, overflow="ellipsis")
    return text


def status_lines(shown: StatusShown, width: int, _height: int) -> Text:
    """Return what the run does, waits for, or is stuck on, and since when; whole, in as many lines as it takes."""
    word, sentence = status_words(shown)
    sign, style = SIGNS[word]
    prefix = "it seems stuck: " if word == "stuck" else ""
    lines = wrapped(f"{prefix}{sentence}", max(1, width - INDENT))
    text = Text(f"\n{' ' * INDENT}".join(lines), style if word in ("fails", "stuck", "gone") else "")
    return Text.assemble((f"{sign} ", style), text)


def arena(shown: StatusShown, width: int, height: int) -> Text:
    """Return the arena from above; empty where a run has none, as calibration."""
    seen = shown.status.arena
    trials = shown.status.learning.trials if shown.status.learning else 1
    return arena_panel(seen, trials, width, height) if seen and width and height else Text()


def moment(shown: StatusShown, width: int, _height: int) -> Text:
    """Return which moment is shown."""
    at = clock_time(shown.status.at)
    text = Text(f"as it was at {at}" if shown.is_past else f"now, {at}", "reverse" if shown.is_past else "dim")
    text.truncate(width)
    return text


WIDTH = 80
LEGEND = 3
"""Lines for what the signs mean: with them, and no more, a cell is a line high."""


def plain_line(shown: StatusShown) -> str:
    """Return what the run does now, in a line."""
    word, sentence = status_words(shown)
    return sentence if word in ("ended", "gone") else f"{clock_time(shown.status.at)}  {sentence}"


def plain_end(shown: StatusShown) -> list[str]:
    """Return how far the run is, and its arena."""
    status = shown.status
    lines = learning_lines(status.learning) if status.learning else []
    if status.arena:
        trials = status.learning.trials if status.learning else 1
        lines += arena_panel(status.arena, trials, WIDTH, status.arena.size + LEGEND).plain.splitlines()
    return lines
