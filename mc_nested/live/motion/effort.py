"""Counts of what moves and placings took."""

from dataclasses import dataclass


@dataclass
class Effort:
    """Counts so far: moves and the corrections after them, clicks and those that had to be repeated."""

    moves: int = 0
    corrections: int = 0
    clicks: int = 0
    second_clicks: int = 0
