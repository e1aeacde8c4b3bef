"""Positions and directions as the debug screen words them (FACTS: The F3 debug screen)."""

from math import floor

from mc_nested.live.model.reading import Block

_FACINGS = (
    "south (Towards positive Z)",
    "west (Towards negative X)",
    "north (Towards negative Z)",
    "east (Towards positive X)",
)


def towards(yaw: float) -> str:
    """The direction nearest to a yaw in degrees, and its axis in brackets."""
    return _FACINGS[floor(yaw / 90 + 0.5) & 3]


def chunk_of(block: Block) -> str:
    """The chunk that a block is in, and its place in the region's file, from 1.19.3 on."""
    x, y, z = block
    return f"{x >> 4} {y >> 4} {z >> 4} [{x >> 4 & 31} {z >> 4 & 31} in r.{x >> 9}.{z >> 9}.mca]"


def section_of(block: Block) -> str:
    """A block's place in its chunk's section, from 1.21.9 on."""
    x, y, z = block
    return f"{x & 15:02d} {y & 15:02d} {z & 15:02d}"
