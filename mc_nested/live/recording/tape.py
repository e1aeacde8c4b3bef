"""Tape: every call to the devices of a run, in order, with what it returned.

A call is a list of plain values: its name, what it was asked, what it answered. Calls of the thread that plays are in
their order, and nothing else decides what it does next; so the same calls, answered alike, are the same run.

["now", 12.5]                        the clock's time            ["key", "press", "w"]     a key goes down
["sleep", 12.55]                     until then                  ["screen", "read", [], answer, pixels]
["front", true]                      whether it is in front      ["note", "acts", {...}]   what the journal was told
"""

import threading
import time
from collections import deque
from typing import Any

from mc_nested.live.journal import Fact, NoteKind

Call = list[Any]


class Tape:
    """Collects calls, for a writer to take.

    It belongs to the thread that makes it: what another thread does, as a watchdog that releases a key, is set down as
    ``["elsewhere", ...]``, since its place among the others is chance.
    """

    def __init__(self) -> None:
        self._thread = threading.get_ident()
        self._calls: deque[tuple[int, Call]] = deque()
        self.inside = False
        """Whether a call is under way whose own calls to the devices are part of it."""

    def add(self, *call: Any) -> None:
        """Add a call, at the time of now."""
        if threading.get_ident() != self._thread:
            call = ("elsewhere", *call)
        elif self.inside:
            return
        self._calls.append((time.time_ns(), list(call)))

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Add a note of the journal."""
        self.add("note", kind, facts)

    def take(self) -> list[tuple[int, Call]]:
        """Take what was added since the last time, with the time of day in nanoseconds; any thread may do so."""
        taken: list[tuple[int, Call]] = []
        while self._calls:
            taken.append(self._calls.popleft())
        return taken
