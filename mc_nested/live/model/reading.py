"""The values that the debug screen shows, in the game's words."""

from dataclasses import dataclass

from mc_nested.live.journal import Fact

Block = tuple[int, int, int]


@dataclass(frozen=True)
class Target:
    """The block looked at: its position and its id as the screen shows it, each None where it isn't shown."""

    pos: Block | None = None
    id: str | None = None


XYZ = tuple[float, float, float]
"""A position in the world, in blocks."""


@dataclass(frozen=True)
class Reading:
    """The values on one frame. A frame that can't be read has no ``xyz``, and ``problem`` says why; nothing is guessed.

    ``xyz`` is the position of the player's feet in blocks at the last tick; ``yaw`` and ``pitch`` are degrees;
    ``target`` is None when no block is looked at (FACTS: The F3 debug screen).
    """

    xyz: XYZ | None = None
    yaw: float | None = None
    pitch: float | None = None
    target: Target | None = None
    problem: str | None = None


def facts_of(reading: Reading) -> dict[str, Fact]:
    """Return a reading as the facts of a journal's note: the problem alone if there is one."""
    if reading.problem is not None:
        return {"problem": reading.problem}
    target = (reading.target.pos, reading.target.id) if reading.target else None
    return {"xyz": reading.xyz, "yaw": reading.yaw, "pitch": reading.pitch, "target": target}


@dataclass(frozen=True)
class WorldPose:
    """The position of the player's feet, in blocks, and the view, in degrees."""

    xyz: XYZ
    yaw: float
    pitch: float
