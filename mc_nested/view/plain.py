"""The view as lines of text, where there is no terminal to draw in."""

from mc_nested.view.arena_panel import arena_panel
from mc_nested.view.words import StatusShown, clock_time, learning_lines, status_words

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
