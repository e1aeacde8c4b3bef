"""Scrubber: one moment of a run's past, by its place in the history; pure."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from rich.text import Text

from mc_nested.view.status import Status
from mc_nested.view.words import clock_time


@dataclass(frozen=True)
class Scrubber:
    """A run's history, the oldest first, and the place in it that is shown; it holds one status at least."""

    history: Sequence[Status]
    place: int

    @property
    def status(self) -> Status:
        """What is shown."""
        return self.history[self.place]

    def moved(self, places: int) -> "Scrubber":
        """So many places on, or back where it is negative; it stops at both ends."""
        return replace(self, place=min(max(self.place + places, 0), len(self.history) - 1))

    def jumped(self, tenths: int) -> "Scrubber":
        """So many tenths of the whole on, by one place at least."""
        step = max(1, len(self.history) // 10)
        return self.moved(tenths * step)

    def line(self, width: int) -> Text:
        """The whole run as a line, with a mark where it is, and the times of its ends."""
        first, last = clock_time(self.history[0].at), clock_time(self.history[-1].at)
        room = max(1, width - len(first) - len(last) - 2)
        mark = self.place * (room - 1) // max(1, len(self.history) - 1)
        return Text.assemble(f"{first} ", ("━" * mark, "cyan"), ("●", "bold cyan"), "─" * (room - 1 - mark), f" {last}")
