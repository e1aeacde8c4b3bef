"""Status: all that the live view shows of a run at one moment. It is plain data, so that a file can hold it."""

from typing import Annotated, Any, Literal, NamedTuple

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario

FORMAT: Literal[1] = 1

MOST_ACTIONS = 40
"""Actions that a status holds, the latest ones; a screen shows as many as it has room for."""

MOST_SCORES = 200
"""Points of the curve."""

MOST_LINES = 8
"""Lines that the run said, the latest ones."""

Mood = Literal["works", "plays", "player", "waits", "fails"]
"""Whether the run goes on, does something in a running game that takes seconds, leaves that to a player who has taken
over, waits, or was set back."""

Size = Annotated[int, Field(ge=1, le=32)]


def _as_text(words: object) -> object:
    return words.encode(errors="replace").decode() if isinstance(words, str) else words


Words = Annotated[str, BeforeValidator(_as_text)]
"""Text as a file can hold it: a path's name may have bytes that are no text."""


class Standing(NamedTuple):
    """A cell, and in how many of the trials something is there now."""

    x: int
    y: int
    trials: int


class ActionSeen(NamedTuple):
    """One action that was confirmed: its name, where it led, where a block landed, and its seconds, if it took any."""

    name: str
    cell: Cell
    placed: Cell | None
    seconds: float | None


class ArenaSeen(BaseModel):
    """The arena from above: its size, the design, what stands, where the agents are.

    ``beliefs``, where the run learns its game: a text of a sign a cell for each row, the nearest row first, with the
    signs of report/terminal.py. ``objective``: the cell that the agent is after, if it has one.
    """

    model_config = ConfigDict(frozen=True)

    size: Size
    design: tuple[Cell, ...]
    stands: tuple[Standing, ...] = ()
    agents: tuple[Standing, ...] = ()
    beliefs: tuple[str, ...] = ()
    parts: tuple[tuple[Cell, ...], ...] = ()
    objective: Cell | None = None

    @classmethod
    def of(cls, scenario: Scenario, **seen: Any) -> "ArenaSeen":
        """Return the arena of a scenario, with what is seen in it."""
        parts = tuple(tuple(sorted(part.cells)) for part in scenario.parts)
        return cls(size=scenario.size, design=tuple(sorted(scenario.design)), parts=parts, **seen)


class ReadingSeen(BaseModel):
    """What was last read of the game's debug screen, or why it could not be read."""

    model_config = ConfigDict(frozen=True)

    position: tuple[float, float, float] | None = None
    yaw: float | None = None
    pitch: float | None = None
    target: Words | None = None
    problem: Words | None = None


class Learning(BaseModel):
    """How far a training is. Scores are r_M; ``scores`` is the curve, a mean over the trials, the latest at the end.

    ``game_minutes_left`` is an estimate, None outside a running game.
    """

    model_config = ConfigDict(frozen=True, ser_json_inf_nan="constants")

    trials: int = 1
    episodes: int = 0
    episodes_at_most: int = 0
    score: float | None = None
    best: float | None = None
    optimum: float = 0.0
    at_optimum: int = 0
    scores: tuple[float, ...] = ()
    exploring: str = ""
    game_minutes_left: float | None = None


class Status(BaseModel):
    """A run at one moment. Times are seconds since 1970; ``since`` is when it began what it does now.

    ``question`` waits for an answer of a person, by its number; ``can_pause``: it pauses when it is asked to;
    ``pausing``: it does so after what is under way; ``can_take_over``: a player may take over; ``share`` says where the
    actions' time went; ``ended`` how the run ended.
    """

    model_config = ConfigDict(frozen=True, ser_json_inf_nan="constants")

    format: Literal[1]
    at: float = 0.0
    what: Words
    title: Words
    doing: Words = "begins"
    detail: Words = ""
    mood: Mood = "works"
    since: float = 0.0
    can_pause: bool = True
    pausing: bool = False
    paused: bool = False
    stopping: bool = False
    can_take_over: bool = False
    arena: ArenaSeen | None = None
    reading: ReadingSeen | None = None
    actions: tuple[ActionSeen, ...] = ()
    share: Words = ""
    learning: Learning | None = None
    lines: tuple[Words, ...] = ()
    question: Words | None = None
    question_number: int = 0
    ended: Words | None = None
