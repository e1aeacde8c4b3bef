"""The columns of a debug screen as lines, whichever change together."""

from itertools import chain

from sim.client.game.f3_screen import F3Screen, TextLine
from sim.client.game.f3_text import both_columns


def left_lines(screen: F3Screen) -> list[TextLine]:
    return list(chain.from_iterable(both_columns(screen)[0]))


def right_lines(screen: F3Screen) -> list[TextLine]:
    return list(chain.from_iterable(both_columns(screen)[1]))
