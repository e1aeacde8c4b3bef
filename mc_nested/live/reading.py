"""What the debug screen said, in the game's words."""

from dataclasses import dataclass

Block = tuple[int, int, int]


@dataclass(frozen=True)
class Target:
    """The block looked at: its place and its id as the screen shows it, each None where it isn't shown."""

    pos: Block | None
    id: str | None


@dataclass(frozen=True)
class Reading:
    """One frame's reading. Where it could not be read, ``xyz`` is None and ``problem`` says why: never a guess.

    ``xyz`` are the entity's feet in blocks at the last tick; ``yaw`` and ``pitch`` are degrees; ``target`` is None when
    no block is looked at (FACTS: The F3 debug screen).
    """

    xyz: tuple[float, float, float] | None = None
    yaw: float | None = None
    pitch: float | None = None
    target: Target | None = None
    problem: str | None = None
