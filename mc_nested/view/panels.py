"""The parts of the view, each from a status to text: title, status line, arena, side, and where in time it is.

Where there is no terminal to draw in, the view is lines of text.
"""

from rich.text import Text

from mc_nested.view.arena_panel import arena_panel
from mc_nested.view.side_panel import side_panel
from mc_nested.view.words import StatusShown, clock_time, learning_lines, status_words, wrapped

SIGNS = {
    "works": ("▶", "bold green"),
    "plays": ("▶", "bold green"),
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
    """What is done, in a line."""
    text = Text(f"{shown.status.what}: {shown.status.title}", "bold", no_wrap=True)
    text.truncate(width, overflow="ellipsis")
    return text


def status_lines(shown: StatusShown, width: int) -> Text:
    """What the run does, waits for, or is stuck on, and since when; whole, in as many lines as it takes."""
    word, sentence = status_words(shown)
    sign, style = SIGNS[word]
    prefix = "it seems stuck: " if word == "stuck" else ""
    lines = wrapped(f"{prefix}{sentence}", max(1, width - INDENT))
    text = Text(f"\n{' ' * INDENT}".join(lines), style if word in ("fails", "stuck", "gone") else "")
    return Text.assemble((f"{sign} ", style), text)


def status_line(shown: StatusShown, width: int, _height: int) -> Text:
    """The same, as a part of the view draws it."""
    return status_lines(shown, width)


def arena(shown: StatusShown, width: int, height: int) -> Text:
    """The arena from above; empty where a run has none, as calibration."""
    seen = shown.status.arena
    trials = shown.status.learning.trials if shown.status.learning else 1
    return arena_panel(seen, trials, width, height) if seen and width and height else Text()


def side(shown: StatusShown, width: int, height: int) -> Text:
    """What is beside it."""
    return side_panel(shown.status, width, height)


def moment(shown: StatusShown, width: int, _height: int) -> Text:
    """Which moment is shown."""
    at = clock_time(shown.status.at)
    text = Text(f"as it was at {at}" if shown.is_past else f"now, {at}", "reverse" if shown.is_past else "dim")
    text.truncate(width)
    return text


WIDTH = 80
LEGEND = 3
"""Lines for what the signs mean: with them, and no more, a cell is a line high."""


def plain_line(shown: StatusShown) -> str:
    """What the run does now, in a line."""
    word, sentence = status_words(shown)
    return sentence if word in ("ended", "gone") else f"{clock_time(shown.status.at)}  {sentence}"


def plain_end(shown: StatusShown) -> list[str]:
    """How far it is, and the arena."""
    status = shown.status
    lines = learning_lines(status.learning) if status.learning else []
    if status.arena:
        trials = status.learning.trials if status.learning else 1
        lines += arena_panel(status.arena, trials, WIDTH, status.arena.size + LEGEND).plain.splitlines()
    return lines
