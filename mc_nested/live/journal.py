"""Journal: what a live run waits for, reads, plans and does, as it happens; a recording keeps it, a view shows it."""

from typing import Literal, Protocol

NoteKind = Literal[
    "waits", "resets", "stands", "acts", "follows", "done", "reads", "plans", "clicks", "types", "recovers", "fails"
]
"""The kinds of notes, with their facts:

waits     on: what has to happen first, in words            recovers  screen: which one is left, to get to the world
resets    material: its number; placed, pressed, tick_phase: what the game knows from before
stands    cell: where the agent is after a reset
acts      action: its number; cell: where it begins; with parts, material: the number of the one to take in hand;
          following: the action that was announced to come next, and its material or None
follows   the player has taken over, and does the action that was asked for, or another one
done      cell; placed: a cell or None; seconds; where the player did another action, instead: its number
reads     xyz, yaw, pitch, target: what the debug screen says; or problem: why it can't be read
plans     key, ticks, sneak: the next hold of a key         clicks    attempt: 0 for the first click of a block
types     line: a command that is typed into the chat       fails     problem: the error, in words
"""

Fact = str | int | float | bool | None | tuple["Fact", ...]


class Journal(Protocol):
    """Takes notes. It returns at once and raises nothing: an agent is at its keys meanwhile."""

    def note(self, kind: NoteKind, /, **facts: Fact) -> None: ...


class Journals:
    """Any number of journals that get the same notes; with none, nothing is kept."""

    def __init__(self, *journals: Journal) -> None:
        self._journals = journals

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Give the note to each journal."""
        for journal in self._journals:
            journal.note(kind, **facts)
