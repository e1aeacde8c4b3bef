"""The content of a debug screen before it is put into words, and the words that all versions share.

Those are positions, directions, and the tags of blocks by version (FACTS: The F3 debug screen).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from math import floor
from typing import NamedTuple

from mc_nested.live.model.reading import Block, Target
from sim.client.game.debug_entries import TUTORIAL, shown_entries
from sim.client.game.edition import Edition, Layout

VERSIONS: dict[Layout, str] = {
    "1.8-1.12": "1.12.2",
    "1.13-1.15": "1.15.2",
    "1.16-1.19.2": "1.16.4",
    "1.19.3-1.21.8": "1.20.2",
    "1.21.9-26.3": "26.1",
    "standin": "1.18.2",
    "26.4": "26.4-snapshot-2",
}
"""A version of each layout."""

BY_ENTRIES: tuple[Layout, ...] = ("1.21.9-26.3", "26.4")
"""The layouts whose lines are chosen one by one."""

Stood = tuple[tuple[str, ...], tuple[str, ...]]
"""Which boxes stood in the left and in the right column in the frame before, from the top (26.4 on)."""


class TextLine(NamedTuple):
    """A line of the screen; ``value`` is the end of ``text`` that has its own colour: true or false."""

    text: str = ""
    value: str = ""
    underlined: bool = False


Part = tuple[TextLine, ...]
"""Lines below each other that change together: what stays the same from frame to frame need not be drawn again."""

EMPTY: Part = (TextLine(),)


def plain(*texts: str) -> Part:
    """Return plain lines of these texts."""
    return tuple(map(TextLine, texts))


def property_lines(properties: Iterable[tuple[str, str]]) -> Part:
    """Return the lines of a block's properties."""
    return tuple(
        TextLine(f"{name}: {value}", value if value in ("true", "false") else "") for name, value in properties
    )


@dataclass(frozen=True)
class F3Screen:
    """The content of one debug screen. ``xyz`` in blocks, ``yaw`` and ``pitch`` in degrees; yaw is wrapped to +-180.

    ``target`` is the block looked at, its id with the namespace where the layout shows one. ``properties`` and ``tags``
    are that block's. ``fluid`` is a water block looked at, ``entity`` the position of a pig. ``reduced`` is
    reducedDebugInfo. ``version`` is the game's, or empty for one with this layout. ``fps`` is the frames a second,
    ``size`` the window's width and height in framebuffer pixels.

    From 1.21.9 on ``entries`` are the ids of what is on, in their order: None for what the tutorial asks for. Without
    ``has_f3`` they are on by themselves. ``stood`` is where the boxes of 26.4 stood before.
    """

    layout: Layout
    gui_scale: int
    xyz: tuple[float, float, float]
    yaw: float
    pitch: float
    target: Target | None = None
    properties: tuple[tuple[str, str], ...] = ()
    tags: tuple[str, ...] = ()
    fluid: Block | None = None
    entity: tuple[float, float, float] | None = None
    reduced: bool = False
    version: str = ""
    fps: int = 120
    size: tuple[int, int] = (1920, 1080)
    entries: tuple[str, ...] | None = None
    has_f3: bool = True
    stood: Stood = ((), ())

    @property
    def title(self) -> str:
        """The line that names the game and its version."""
        name = self.edition.version
        if self.layout == "standin":
            return f"Prismarine Web Client ({name})"
        return f"Minecraft {name} ({name}/vanilla)"

    @property
    def rows(self) -> int:
        """The window's height in GUI pixels; the last one may be cut."""
        return -(-self.size[1] // self.gui_scale)

    @cached_property
    def edition(self) -> Edition:
        """The game's version."""
        return Edition(self.version or VERSIONS[self.layout])

    @property
    def block(self) -> Block:
        """The block that the feet are in."""
        x, y, z = self.xyz
        return floor(x), floor(y), floor(z)

    @cached_property
    def shown(self) -> tuple[str, ...]:
        """The ids of the entries that are on the screen, in their order; none before 1.21.9."""
        if self.entries is not None:
            return self.entries
        return shown_entries(TUTORIAL, self.edition, has_f3=True, is_reduced=self.reduced)

    @property
    def has_axes(self) -> bool:
        """Whether the crosshair is one of three axes."""
        return self.layout not in BY_ENTRIES or "3d_crosshair" in self.shown


_FACINGS = (
    "south (Towards positive Z)",
    "west (Towards negative X)",
    "north (Towards negative Z)",
    "east (Towards positive X)",
)


def towards(yaw: float) -> str:
    """Return the direction nearest to a yaw in degrees, and its axis in brackets."""
    return _FACINGS[floor(yaw / 90 + 0.5) & 3]


def chunk_of(block: Block) -> str:
    """Return the chunk that a block is in, and its place in the region's file, from 1.19.3 on."""
    x, y, z = block
    return f"{x >> 4} {y >> 4} {z >> 4} [{x >> 4 & 31} {z >> 4 & 31} in r.{x >> 9}.{z >> 9}.mca]"


def section_of(block: Block) -> str:
    """Return a block's place in its chunk's section, from 1.21.9 on."""
    x, y, z = block
    return f"{x & 15:02d} {y & 15:02d} {z & 15:02d}"


_PICKAXE = "minecraft:mineable/pickaxe"


def tags_of(block: str, edition: Edition) -> tuple[str, ...]:
    """Return a block's tags, without #. The game may order them anew each time it starts; here the order is fixed."""
    if not edition.since(1, 13):
        return ()
    tags = _TAGS.get(block, ())
    return tuple(tag for since, tag in tags if edition.since(*since))


_TAGS: dict[str, tuple[tuple[tuple[int, ...], str], ...]] = {
    "oak_planks": (((1, 13), "minecraft:planks"), ((1, 17), "minecraft:mineable/axe")),
    "stone": (
        ((1, 17), _PICKAXE),
        ((1, 18), "minecraft:base_stone_overworld"),
        ((1, 18), "minecraft:lush_ground_replaceable"),
    ),
    "obsidian": (((1, 17), _PICKAXE), ((1, 20, 5), "minecraft:incorrect_for_wooden_tool")),
}
"""Each tag with the first version that has it. The long ones meet the left column in a narrow window."""
