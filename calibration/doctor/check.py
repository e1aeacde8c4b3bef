"""A row of the doctor's table: what was looked at, how it stands, what was found, and the one thing to do."""

from dataclasses import dataclass
from typing import Literal

Status = Literal["pass", "warn", "fail", "skip"]
"""Good; works, but not always; keeps the agent from playing; can't be known now."""

NAMES = (
    "session",
    "display scaling",
    "profile",
    "profile fits",
    "font",
    "game's window",
    "in front",
    "size and GUI scale",
    "debug screen",
    "reduced debug info",
    "position line",
    "looked-at line",
    "options.txt",
    "pauseOnLostFocus",
    "autoJump",
    "guiScale",
    "forceUnicodeFont",
    "fullscreen",
    "toggleCrouch",
    "language",
    "keys",
    "clipboard",
    "input",
)
"""Every row that there is, in the table's order, whatever could be looked at."""


@dataclass(frozen=True)
class Check:
    """A row; ``name`` is one of ``NAMES``, and ``fix`` is empty where nothing has to be done."""

    name: str
    status: Status
    detail: str
    fix: str = ""


def told(name: str, status: Status, message: str) -> Check:
    """The row of an error or a reading's problem, whose message is what is wrong, a colon, and what to do."""
    detail, _, fix = message.partition(": ")
    return Check(name, status, detail, fix)
