"""Board: what a run does now, set down by the thread that plays, and read by the one that publishes it."""

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any, cast

from mc_nested.arena.action import Action
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.view.narration import DETAIL, Doing, action_seen, detail_of, doing_of, reading_seen
from mc_nested.view.status import FORMAT, MOST_ACTIONS, ActionSeen, Mood, Status


class Board:
    """Holds a run's status. It is a journal: what it is told takes microseconds, since an agent is at its keys.

    Args:
        what: the run's verb.
        title: what is done, in a line.
        clock: seconds since 1970.
    """

    def __init__(self, what: str, title: str, clock: Callable[[], float] = time.time) -> None:
        self._clock = clock
        self._fields: dict[str, Any] = {"format": FORMAT, "what": what, "title": title, "since": clock()}
        self._actions: deque[ActionSeen] = deque(maxlen=MOST_ACTIONS)
        self._action = Action.F
        self._reading: dict[str, Fact] | None = None
        self._own = "begins"
        self._before_waiting = Doing(self._own)
        self._lock = threading.Lock()

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Take a note of the journal."""
        if kind == "reads":
            self._reading = facts
            if "problem" not in facts:
                self._wait_no_longer()
        elif kind in DETAIL:
            self._wait_no_longer()
            self._fields["detail"] = detail_of(kind, facts)
        elif kind == "done":
            with self._lock:
                self._actions.append(action_seen(self._action, facts))
            self._begin(Doing("chooses what to do next, or practises"))
        elif doing := doing_of(kind, facts):
            if kind == "acts":
                self._action = Action(cast("int", facts["action"]))
            self._begin(doing)

    def does(self, text: str, mood: Mood = "works") -> None:
        """What the run does from now on; said again, it goes on as before."""
        if self._own != text:
            self._own = text
            self._begin(Doing(text, mood))

    def go_on(self) -> None:
        """A pause is over: what is done begins anew."""
        self.show(paused=False, since=self._clock())

    def show(self, **fields: Any) -> None:
        """Set fields of the status (``Status``)."""
        with self._lock:
            self._fields.update(fields)

    def status(self) -> Status:
        """All of it as it is now."""
        with self._lock:
            fields = {**self._fields, "actions": tuple(self._actions)}
        if (reading := self._reading) is not None:
            fields["reading"] = reading_seen(reading)
        return Status(at=self._clock(), **fields)

    def _wait_no_longer(self) -> None:
        if self._fields.get("mood") == "waits":
            self._begin(self._before_waiting)

    def _begin(self, doing: Doing) -> None:
        if doing.mood in ("works", "plays"):
            self._before_waiting = doing
        with self._lock:
            self._fields.update(doing=doing.text, mood=doing.mood, detail="", since=self._clock())
