"""The words of the view: times, the status line, and how far a training is."""

import textwrap
import time
from dataclasses import dataclass
from typing import Literal

from mc_nested.view.status import Learning, Status

Life = Literal["runs", "ended", "gone"]
"""A run is under way; it said that it ended; or its process is gone without a word, as after a kill."""

FRESH_S = 5.0
"""A run publishes its status three times a second."""

LONG_S = 10.0
"""What an action, a click or a reset doesn't take: from here on a run counts as stuck."""


@dataclass(frozen=True)
class StatusShown:
    """What a view shows: a status, the time it is looked at, whether the run lives, and if it is of the past."""

    status: Status
    now: float
    life: Life = "runs"
    is_past: bool = False


def life_of(status: Status, is_published: bool, now: float) -> Life:
    """Return whether a run is under way, by its status and by whether a living process is known to publish it.

    Some disks know no locks: there, a status of just now says that it is.
    """
    if status.ended is not None:
        return "ended"
    return "runs" if is_published or now - status.at < FRESH_S else "gone"


def lasting(seconds: float) -> str:
    """Return a time span in its two largest units."""
    whole = max(0, int(seconds))
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def clock_time(at: float) -> str:
    """Return the time of day, here."""
    return time.strftime("%H:%M:%S", time.localtime(at))


def status_words(shown: StatusShown) -> tuple[str, str]:
    """Return what the run does, waits for, or is stuck on, and since when; and the word that says how it goes."""
    status = shown.status
    if shown.life == "gone":
        return "gone", f"the run's process is gone; it was last seen at {clock_time(status.at)}: {status.doing}"
    if status.ended is not None:
        return "ended", f"ended at {clock_time(status.at)}: {status.ended}"
    if (silent := shown.now - status.at) >= LONG_S:
        return "stuck", f"nothing was heard of the run for {lasting(silent)}; before: {status.doing}"
    since = f"for {lasting(shown.now - status.since)}"
    if asked := _asked_words(status, since):
        return asked
    detail = f": {status.detail}" if status.detail else ""
    is_stuck = status.mood == "plays" and shown.now - status.since >= LONG_S
    return ("stuck" if is_stuck else status.mood), f"{status.doing}{detail}, {since}"


def _asked_words(status: Status, since: str) -> tuple[str, str] | None:
    """Return the words where a person was asked something, or asked for something; None where neither is so."""
    if status.question is not None:
        return "asks", f"{status.question} Press y for yes, n for no."
    if status.stopping:
        return "stops", f"stopping: what is under way ends, then it is saved ({status.doing}, {since})"
    if status.paused:
        return "paused", f"paused; press p to go on ({status.doing})"
    if status.pausing:
        return "paused", f"pauses after what is under way; press p to go on ({status.doing}, {since})"
    return None


def wrapped(text: str, width: int) -> list[str]:
    """Return a text as lines of at most so many characters, one at least, broken between words.

    A longer word has a line of its own.
    """
    lines = textwrap.wrap(" ".join(text.split()), max(1, width), break_long_words=False, break_on_hyphens=False)
    return lines or [""]


def learning_lines(learning: Learning) -> list[str]:
    """Return episodes, score and game time left, a line each."""
    lines = [f"{learning.episodes:,} of at most {learning.episodes_at_most:,} episodes"]
    if learning.trials > 1:
        lines.append(f"{learning.trials} trials, {learning.at_optimum} at the optimum")
    if learning.score is not None:
        of_all = " (means)" if learning.trials > 1 else ""
        best = "" if learning.best is None else f", best {learning.best:.4g}"
        lines.append(f"last score {learning.score:.4g}{best}, of {learning.optimum:.4g}{of_all}")
    if learning.exploring:
        lines.append(learning.exploring)
    if learning.game_minutes_left is not None:
        lines.append(f"game time left: about {lasting(60 * learning.game_minutes_left)}")
    return lines
