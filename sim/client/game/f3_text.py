"""The text of each version's debug screen, line by line (FACTS: The F3 debug screen)."""

from dataclasses import dataclass
from functools import lru_cache
from itertools import chain
from math import floor
from typing import Literal, NamedTuple, get_args

from mc_nested.live.model.reading import Block, Target

Layout = Literal["1.8-1.12", "1.13-1.15", "1.16-1.19.2", "1.19.3-1.21.8", "1.21.9-26.3", "standin", "26.4"]
LAYOUTS: tuple[Layout, ...] = tuple(layout for layout in get_args(Layout) if layout != "26.4")
"""Those that can be read; 26.4 puts the same contents into boxes (drawing/f3_groups.py)."""

_VERSIONS: dict[Layout, str] = {
    "1.8-1.12": "Minecraft 1.12.2 (1.12.2/vanilla)",
    "1.13-1.15": "Minecraft 1.15.2 (1.15.2/vanilla)",
    "1.16-1.19.2": "Minecraft 1.16.4 (1.16.4/vanilla)",
    "1.19.3-1.21.8": "Minecraft 1.20.2 (1.20.2/vanilla)",
    "1.21.9-26.3": "Minecraft 26.1 (26.1/vanilla)",
    "standin": "Prismarine Web Client (1.18.2)",
    "26.4": "Minecraft 26.4-snapshot-1 (26.4-snapshot-1/vanilla)",
}
_FACINGS = (
    "south (Towards positive Z)",
    "west (Towards negative X)",
    "north (Towards negative Z)",
    "east (Towards positive X)",
)


class TextLine(NamedTuple):
    """A line of the screen; ``value`` is the end of ``text`` that has its own colour: true or false."""

    text: str = ""
    value: str = ""
    underlined: bool = False


Part = tuple[TextLine, ...]
"""Lines below each other that change together: what stays the same from frame to frame need not be drawn again."""

_EMPTY: Part = (TextLine(),)


@dataclass(frozen=True)
class F3Screen:
    """The content of one debug screen. ``xyz`` in blocks, ``yaw`` and ``pitch`` in degrees; yaw is wrapped to +-180.

    ``target`` is the block looked at, its id with the namespace where the layout shows one. ``properties`` and ``tags``
    are that block's. ``fluid`` is a water block looked at. ``swapped`` puts the groups of 1.21.9 and later on the other
    side; the game spreads them by their count. ``reduced`` is reducedDebugInfo. ``version`` is the game's, or empty for
    one with this layout. ``fps`` is the frames a second, ``size`` the window's width and height in framebuffer pixels.
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
    swapped: bool = False
    reduced: bool = False
    version: str = ""
    fps: int = 120
    size: tuple[int, int] = (1920, 1080)

    @property
    def title(self) -> str:
        """The first line: the game and its version."""
        return f"Minecraft {self.version} ({self.version}/vanilla)" if self.version else _VERSIONS[self.layout]

    @property
    def block(self) -> Block:
        """The block that the feet are in."""
        x, y, z = self.xyz
        return floor(x), floor(y), floor(z)


def left_lines(screen: F3Screen) -> list[TextLine]:
    """The left column, from the top."""
    return list(chain.from_iterable(left_parts(screen)))


def right_lines(screen: F3Screen) -> list[TextLine]:
    """The right column, from the top."""
    return list(chain.from_iterable(right_parts(screen)))


def left_parts(screen: F3Screen) -> list[Part]:
    """The left column, from the top, in parts."""
    if screen.layout == "standin":
        return _standin_left(screen)
    counts = _counts(screen.layout, screen.title, screen.fps)
    if screen.reduced:
        x, y, z = screen.block
        return [counts, _EMPTY, _plain(f"Chunk-relative: {x & 15} {y & 15} {z & 15}")]
    if screen.swapped:
        # Lower than the lines of the right column that a long line would run into.
        return [counts, *[_EMPTY] * 6, *_right_groups(screen)]
    return [counts, _EMPTY, *_position(screen), *_looking(screen)]


def right_parts(screen: F3Screen) -> list[Part]:
    """The right column, from the top, in parts."""
    if screen.layout == "standin":
        return [_plain("Renderer: three.js r128", ""), *_standin_target(screen)]
    machine = _machine(screen.layout)
    if screen.reduced:
        return [machine]
    if screen.swapped:
        return [machine, *_position(screen)]
    return [machine, _graphics(screen.size), *_right_groups(screen)]


def _plain(*texts: str) -> Part:
    return tuple(map(TextLine, texts))


@lru_cache(16)
def _machine(layout: Layout) -> Part:
    rate = ["Allocation rate: 120MB /s"] if layout in ("1.19.3-1.21.8", "1.21.9-26.3", "26.4") else []
    return _plain(
        *("Java: 21.0.3 64bit", "Mem: 23% 480/2048MB", *rate, "Allocated: 41% 840MB", "", "CPU: 4x AMD Ryzen 5", "")
    )


@lru_cache(16)
def _graphics(size: tuple[int, int]) -> Part:
    return _plain("Display: {}x{} (AMD)".format(*size), "AMD Radeon", "4.6 Core Profile", "")


@lru_cache(64)
def _counts(layout: Layout, title: str, fps: int) -> Part:
    rate, limit = f"{fps} fps", f"T: {fps}"
    if layout == "1.8-1.12":
        return _plain(
            *(title, f"{rate} (0 chunk updates) {limit} vsync fancy vbo", "C: 118/7225 (s) D: 8, pC: 000"),
            *("E: 1/22, B: 0", "P: 0. T: All: 22", "MultiplayerChunkCache: 841, 841"),
        )
    return _plain(
        *(title, f"{rate} {limit} vsync fancy fancy-clouds", "Integrated server @ 4 ms ticks, 12 tx, 700 rx"),
        *("C: 302/7225 (s) D: 8, pC: 000", "E: 1/22, B: 0, SD: 8", "P: 0. T: 22"),
        *("Chunks[C] W: 529, 361 E: 59,38,59", "Chunks[S] W: 3249 E: 59,38,59", "minecraft:overworld FC: 0"),
    )


def _position(screen: F3Screen) -> list[Part]:
    (px, py, pz), (x, y, z), layout = screen.xyz, screen.block, screen.layout
    inside = f"{x & 15} {y & 15} {z & 15}"
    block = f"Block: {x} {y} {z}" + (f" [{inside}]" if layout == "1.19.3-1.21.8" else "")
    chunk = f"Chunk: {inside} in {x >> 4} {y >> 4} {z >> 4}"
    if layout in ("1.19.3-1.21.8", "1.21.9-26.3", "26.4"):
        chunk = f"Chunk: {x >> 4} {y >> 4} {z >> 4} [{x >> 4 & 31} {z >> 4 & 31} in r.{x >> 9}.{z >> 9}.mca]"
    section = [f"Section-relative: {x & 15:02d} {y & 15:02d} {z & 15:02d}"] if layout in ("1.21.9-26.3", "26.4") else []
    return [
        _plain(f"XYZ: {px:.3f} / {py:.5f} / {pz:.3f}"),
        _plain(block, *section, chunk),
        _plain(f"Facing: {_towards(screen.yaw)} ({screen.yaw:.1f} / {screen.pitch:.1f})"),
        _surroundings(layout),
    ]


@lru_cache(16)
def _surroundings(layout: Layout) -> Part:
    biome = "Biome: Plains" if layout == "1.8-1.12" else "Biome: minecraft:plains"
    return _plain("Client Light: 15 (15 sky, 0 block)", biome, "Local Difficulty: 0.00")


def _looking(screen: F3Screen) -> list[Part]:
    parts = _looking_at_block(screen)
    if screen.fluid is not None and screen.layout == "1.13-1.15":
        parts.append(_plain("Looking at liquid: {} {} {}".format(*screen.fluid)))
    return parts


def _looking_at_block(screen: F3Screen) -> list[Part]:
    if screen.target is None or screen.target.pos is None:
        return []
    x, y, z = screen.target.pos
    if screen.layout == "1.8-1.12":
        return [_plain(f"Looking at: {x} {y} {z}")]
    return [_plain(f"Looking at block: {x} {y} {z}")] if screen.layout == "1.13-1.15" else []


def _right_groups(screen: F3Screen) -> list[Part]:
    """The block and the fluid looked at, as far as the right column shows them."""
    return [_target_group(screen), _fluid_group(screen)]


def _target_group(screen: F3Screen) -> Part:
    if screen.target is None:
        return ()
    tags = _plain(*(f"#{tag}" for tag in screen.tags))
    about = (TextLine(screen.target.id or ""), *_properties(screen), *tags, TextLine())
    if screen.layout == "1.8-1.12":
        return about
    if screen.layout == "1.13-1.15" or screen.target.pos is None:
        return (TextLine("Targeted Block", underlined=True), *about)
    x, y, z = screen.target.pos
    return (TextLine(f"Targeted Block: {x}, {y}, {z}", underlined=True), *about)


def _fluid_group(screen: F3Screen) -> Part:
    if screen.fluid is None or screen.layout == "1.8-1.12":
        return ()
    x, y, z = screen.fluid
    label = "Targeted Fluid" if screen.layout == "1.13-1.15" else f"Targeted Fluid: {x}, {y}, {z}"
    return (TextLine(label, underlined=True), *_plain("minecraft:water", "level: 8", "#minecraft:water"))


def _properties(screen: F3Screen) -> Part:
    return tuple(
        TextLine(f"{name}: {value}", value if value in ("true", "false") else "") for name, value in screen.properties
    )


def _standin_left(screen: F3Screen) -> list[Part]:
    (px, py, pz), (x, _, z) = screen.xyz, screen.block
    towards = _towards(screen.yaw).replace("Towards", "towards")
    return [
        _plain(
            _VERSIONS["standin"],
            "E: 1",
            "minecraft:overworld",
            "",
            f"XYZ: {px:.3f} / {py:.3f} / {pz:.3f}",
            f"Chunk: {x % 16} ~ {z % 16} in {x // 16} ~ {z // 16}",
            "Facing (viewer): 3.142 -1.065",
            f"Facing (minecraft): {towards} ({screen.yaw:.1f} {screen.pitch:.1f})",
            "Light: 15 (15 sky)",
            "Biome: minecraft:plains",
            "Day: 0",
        )
    ]


def _standin_target(screen: F3Screen) -> list[Part]:
    if screen.target is None or screen.target.pos is None:
        return []
    x, y, z = screen.target.pos
    return [(TextLine(screen.target.id or ""), *_properties(screen), TextLine(f"Looking at: {x} {y} {z}"))]


def _towards(yaw: float) -> str:
    return _FACINGS[floor(yaw / 90 + 0.5) & 3]
