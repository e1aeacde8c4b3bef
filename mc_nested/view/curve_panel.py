"""A curve of scores in a terminal, in eighths of a line."""

from collections.abc import Sequence

import numpy as np
from rich.text import Text

WIDEST = 3
"""Columns of an episode, while there are few."""

EIGHTHS = " ▁▂▃▄▅▆▇█"


def curve_panel(scores: Sequence[float], highest: float, width: int, height: int) -> Text:
    """The scores from 0 to the highest one, up to three columns each, or a column for the mean of several."""
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
