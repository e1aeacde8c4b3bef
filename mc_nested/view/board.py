"""Board: what a run does now, in plain words. The thread that plays writes it, another one publishes it."""

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

from mc_nested.arena.action import Action, Cell
from mc_nested.live.action_log import Spent
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.view.status import FORMAT, MOST_ACTIONS, ActionSeen, Mood, ReadingSeen, Status

MOVES = {"F": "forward", "B": "back", "L": "left", "R": "right"}

DETAIL: tuple[NoteKind, ...] = ("plans", "clicks", "types")
"""Notes of a part of what is done: they don't begin anything new."""


@dataclass(frozen=True)
class Doing:
    """What a run does from a note on, and in which mood (``Mood``)."""

    text: str
    mood: Mood = "works"


def doing_of(kind: NoteKind, facts: dict[str, Fact]) -> Doing | None:
    """Return what the run begins with that note; None where it begins nothing new."""
    match kind:
        case "waits":
            doing = Doing(f"waits for {facts['on']}", "waits")
        case "resets":
            doing = Doing("resets the arena: clears it, goes to the start, takes the material in hand", "plays")
        case "stands":
            doing = Doing("stands at the start, and chooses")
        case "acts":
            (x, y), action = cast("Cell", facts["cell"]), Action(cast("int", facts["action"]))
            doing = Doing(f"{words_of(action)}, from ({x}, {y})", "plays")
        case "follows":
            doing = Doing("the player plays, and gives back with the same key", "player")
        case "recovers":
            doing = Doing(f"finds its way back to the world, from the screen: {facts['screen']}", "waits")
        case "fails":
            doing = Doing(f"was set back: {facts['problem']}", "fails")
        case _:
            return None
    return doing


def detail_of(kind: NoteKind, facts: dict[str, Fact]) -> str:
    """Return which part of an activity is under way, in words; empty where the note is of no part."""
    match kind:
        case "plans":
            ticks = "1 tick" if facts["ticks"] == 1 else f"{facts['ticks']} ticks"
            return f"holds {facts['key']} for {ticks}{', sneaking' if facts['sneak'] else ''}"
        case "clicks":
            attempt = cast("int", facts["attempt"])
            return f"clicks again, the block was not seen: attempt {attempt + 1}" if attempt else "clicks"
        case "types":
            return f"types {facts['line']}"
    return ""


def words_of(action: Action) -> str:
    """Return an action in words, with its name in the paper."""
    move, places = MOVES[action.name[0]], action.name.endswith("D")
    return f"moves {move}{' and places a block' if places else ''} ({named(action)})"


def named(action: Action) -> str:
    """Return an action's name in the paper (section 5.1.2), as B+D."""
    return "+".join(action.name)


def action_seen(action: Action, facts: dict[str, Fact]) -> ActionSeen:
    """Return what the note ``done`` says of the action, or of the one that a player did instead."""
    action, placed = Action(cast("int", facts.get("instead", action))), facts["placed"]
    return ActionSeen(
        named(action),
        cast("Cell", facts["cell"]),
        None if placed is None else cast("Cell", placed),
        cast("float", facts["seconds"]),
    )


def reading_seen(facts: dict[str, Fact]) -> ReadingSeen:
    """Return what the note ``reads`` says of the debug screen."""
    if facts.get("problem") is not None:
        return ReadingSeen(problem=str(facts["problem"]))
    xyz = cast("tuple[float, float, float] | None", facts.get("xyz"))
    target = facts.get("target")
    return ReadingSeen(
        position=xyz,
        yaw=cast("float | None", facts.get("yaw")),
        pitch=cast("float | None", facts.get("pitch")),
        target=None if target is None else _target_words(cast("tuple[tuple[int, int, int], str]", target)),
    )


def _target_words(target: tuple[tuple[int, int, int], str]) -> str:
    (x, y, z), name = target
    return f"{name} at {x} {y} {z}"


class Board:
    """A journal that holds a run's status. It takes each note in microseconds, as the agent is pressing keys meanwhile.

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
        self._spent, self._held_s = Spent(), 0.0
        self._done_at: float | None = None

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Take a note of the journal."""
        if kind == "reads":
            self._reading = facts
            if "problem" not in facts:
                self._wait_no_longer()
        elif kind in DETAIL:
            self._wait_no_longer()
            self._fields["detail"] = detail_of(kind, facts)
            self._held_s += cast("int", facts.get("ticks", 0)) * TICK_S
        elif kind == "done":
            with self._lock:
                self._actions.append(action_seen(self._action, facts))
            self._spend(cast("float", facts["seconds"]))
            self._begin(Doing("chooses what to do next, or practises"))
        elif doing := doing_of(kind, facts):
            if kind == "acts":
                self._action = Action(cast("int", facts["action"]))
                self._spent.deciding += 0.0 if self._done_at is None else self._clock() - self._done_at
            self._done_at = None
            self._begin(doing)

    def _spend(self, seconds: float) -> None:
        """Count the time of an action that took so many seconds; keys were down for the ticks that were planned."""
        walking = min(self._held_s, seconds)
        self._held_s -= walking
        self._spent.walking += walking
        self._spent.confirming += seconds - walking
        self._done_at = self._clock()
        self._fields["share"] = str(self._spent)

    def does(self, text: str) -> None:
        """Set what the run does from now on; repeating it changes nothing."""
        if self._own != text:
            self._own = text
            self._begin(Doing(text, "works"))

    def go_on(self) -> None:
        """End a pause: what is done begins anew."""
        self.show(paused=False, since=self._clock())

    def show(self, **fields: Any) -> None:
        """Set fields of the status (``Status``)."""
        with self._lock:
            self._fields.update(fields)

    def status(self) -> Status:
        """Return the whole status as it is now."""
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
