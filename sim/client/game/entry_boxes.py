"""The debug screen from 26.4 on: what each entry writes into which titled box, and where each box stands.

A box holds facts, a name and a value each, and below them plain lines. What is a value is white, what stands between
values is darker. A box stays in the column of the frame before. One that comes goes into the column that it prefers, or
into the shorter one, below those that are there. A column as high as the window takes no more
(FACTS: The F3 debug screen).
"""

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Literal, NamedTuple

from sim.client.game.f3_screen import F3Screen, Stood, section_of, towards
from sim.client.game.widgets import GLUE, WHITE, Colour

_TRUE: Colour = (0, 255, 0)
_FALSE: Colour = (255, 0, 0)


class Kind(NamedTuple):
    """A kind of box: its title, the colour of its bar, and the column it goes into when it comes; None for any."""

    title: str
    bar: Colour | None = None
    side: Literal["left", "right"] | None = None


class Fact(NamedTuple):
    """A row of a box: a name, and a value as pieces of text with their colours."""

    name: str
    value: tuple[tuple[str, Colour], ...]


class EntryBox(NamedTuple):
    """A box and what is in it."""

    kind: Kind
    facts: tuple[Fact, ...] = ()
    lines: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """The number of its lines of text, the title included."""
        return bool(self.kind.title) + len(self.facts) + len(self.lines)


FIRST = Kind("")
"""The lines with priority."""

MISC, HELP = Kind(""), Kind("Help")
POSITION = Kind("Position", (255, 255, 255), "left")
_MEMORY = Kind("Memory", (255, 155, 0), "right")
_IMPACTORS = Kind("Performance Impactors", (0, 255, 0), "right")
_SPECS = Kind("System Specs", (255, 0, 0), "right")
BLOCK = Kind("Looking At Block", (204, 0, 255))
_FLUID = Kind("Looking At Fluid", (255, 204, 0))
_ENTITY = Kind("Looking At Entity", (0, 255, 204))
_HEIGHTMAP = Kind("Heightmap", (0, 170, 255))
_RENDERING = Kind("Chunk Rendering", (240, 176, 160))
_GENERATION = Kind("Chunk Generation", (153, 255, 170))
_SPAWNS = Kind("Entity Spawn Counts", (255, 68, 68))


def boxes(screen: F3Screen) -> list[EntryBox]:
    """Return all other boxes that have something in them, in the order in which they are given a column."""
    said: dict[str, EntryBox] = {}
    for entry in screen.shown:
        for box in _ENTRIES[entry](screen) if entry in _ENTRIES else ():
            before = said.get(box.kind.title, EntryBox(box.kind))
            said[box.kind.title] = EntryBox(box.kind, before.facts + box.facts, before.lines + box.lines)
    if MISC.title in said:
        said[MISC.title] = said.pop(MISC.title)
    if screen.shown and screen.has_f3:
        said[HELP.title] = _HELP
    return list(said.values())


def _fact(name: str, *texts: str) -> Fact:
    """Return a fact: values, and what stands between them, in turn."""
    pieces = ((text, WHITE if index % 2 == 0 else GLUE) for index, text in enumerate(texts))
    return Fact(name, tuple((text, colour) for text, colour in pieces if text))


def _always(kind: Kind, *facts: Fact, lines: tuple[str, ...] = ()) -> Callable[[F3Screen], tuple[EntryBox, ...]]:
    box = (EntryBox(kind, facts, lines),)
    return lambda _: box


_HELP = EntryBox(
    HELP,
    lines=(
        "Debug charts: [F3+1] Profiler hidden; [F3+2] fps + tps hidden;",
        "[F3+3] Ping hidden; [F3+4] Lightmap hidden",
        "To edit: press [F3+F6]",
    ),
)


def _position(screen: F3Screen) -> tuple[EntryBox, ...]:
    (px, py, pz), (x, y, z) = screen.xyz, screen.block
    direction, axis = towards(screen.yaw).rstrip(")").split(" (")
    inside = f"{x >> 4 & 31}", " ", f"{z >> 4 & 31}", " in ", f"r.{x >> 9}.{z >> 9}.mca", "]"
    facts = (
        _fact("XYZ", f"{px:.3f}", " / ", f"{py:.5f}", " / ", f"{pz:.3f}"),
        _fact("Block", f"{x}", " ", f"{y}", " ", f"{z}"),
        _fact("Chunk", f"{x >> 4}", " ", f"{y >> 4}", " ", f"{z >> 4}", " [", *inside),
        _fact("Facing", direction, " (", axis, ") (", f"{screen.yaw:.1f}", " / ", f"{screen.pitch:.1f}", ")"),
        _fact("Dimension", "minecraft:overworld"),
    )
    return (EntryBox(POSITION, facts),)


def _section(screen: F3Screen) -> tuple[EntryBox, ...]:
    return (EntryBox(POSITION, (_fact("Section-Relative", section_of(screen.block)),)),)


def _block(screen: F3Screen) -> tuple[EntryBox, ...]:
    if screen.target is None or screen.target.pos is None:
        return ()
    return _looked_at(BLOCK, screen.target.pos, screen.target.id or "", screen.properties)


def _fluid(screen: F3Screen) -> tuple[EntryBox, ...]:
    if screen.fluid is None:
        return ()
    return _looked_at(_FLUID, screen.fluid, "minecraft:water", (("falling", "false"), ("level", "8")))


def _entity(screen: F3Screen) -> tuple[EntryBox, ...]:
    if screen.entity is None:
        return ()
    x, y, z = (f"{part:.2f}" for part in screen.entity)
    return (EntryBox(_ENTITY, (_fact("Coordinates", x, ", ", y, ", ", z), _fact("Type", "minecraft:pig"))),)


def _looked_at(
    kind: Kind, pos: tuple[int, int, int], name: str, properties: tuple[tuple[str, str], ...]
) -> tuple[EntryBox, ...]:
    x, y, z = map(str, pos)
    colours = {"true": _TRUE, "false": _FALSE}
    states = (Fact(key, ((value, colours.get(value, WHITE)),)) for key, value in properties)
    return (EntryBox(kind, (_fact("Coordinates", x, ", ", y, ", ", z), _fact("Type", name), *states)),)


def _tags(screen: F3Screen) -> tuple[EntryBox, ...]:
    return (EntryBox(BLOCK, lines=tuple(f"#{tag}" for tag in screen.tags)),) if screen.target and screen.tags else ()


def _fluid_tags(screen: F3Screen) -> tuple[EntryBox, ...]:
    return (EntryBox(_FLUID, lines=("#minecraft:water",)),) if screen.fluid else ()


def _system(screen: F3Screen) -> tuple[EntryBox, ...]:
    return _specs(*screen.size)


@lru_cache(16)
def _specs(width: int, height: int) -> tuple[EntryBox, ...]:
    size = f"{width}", "x", f"{height}"
    facts = (
        _fact("Java", "25.0.2"),
        _fact("CPU", "4x AMD Ryzen 5"),
        _fact("Display", *size, " (", "AMD", ")"),
        _fact("Window", *size, " (", "1.00", "x pixel density)"),
    )
    return (EntryBox(_SPECS, facts, ("AMD Radeon (dGPU)", "Vulkan 1.3.0")),)


_ENTRIES: dict[str, Callable[[F3Screen], tuple[EntryBox, ...]]] = {
    "biome": _always(POSITION, _fact("Biome", "minecraft:plains")),
    "chunk_generation_stats": _always(_GENERATION, lines=("NoiseRouter T: 0.512", "Biome builder PV: Low")),
    "chunk_render_stats": _always(_RENDERING, _fact("Rendered", "302", "/", "7225"), _fact("Distance", "8")),
    "day_count": _always(MISC, _fact("Day", "3")),
    "entity_render_stats": _always(MISC, _fact("Entities", "1", "/", "22")),
    "entity_spawn_counts": _always(_SPAWNS, _fact("Monster", "17"), _fact("Creature", "10")),
    "gpu_utilization": _always(MISC, _fact("GPU", "23", "%")),
    "heightmap": _always(_HEIGHTMAP, _fact("Surface", "63"), _fact("Motion Blocking", "63")),
    "light_levels": _always(MISC, _fact("Light", "15", " (", "15", " sky, ", "0", " block)")),
    "local_difficulty": _always(MISC, _fact("Local Difficulty", "2.25", " // ", "0.05")),
    "looking_at_block_state": _block,
    "looking_at_block_tags": _tags,
    "looking_at_entity": _entity,
    "looking_at_fluid_state": _fluid,
    "looking_at_fluid_tags": _fluid_tags,
    "memory": _always(
        _MEMORY,
        _fact("Used", "23", "% ", "480", "/", "2048", "MiB"),
        _fact("Alloc rate", "035", "MiB/s"),
        _fact("Allocated", "41", "% ", "840", "MiB"),
    ),
    "particle_render_stats": _always(MISC, _fact("Particles", "22")),
    "player_position": _position,
    "player_section_position": _section,
    "simple_performance_impactors": _always(
        _IMPACTORS,
        *(_fact("OIT", "Off"), _fact("Clouds", "Fancy"), _fact("Biome Blend", "2"), _fact("Filtering", "RGSS")),
        _fact("Multi-draw", "On"),
    ),
    "sound_mood": _always(MISC, _fact("Sounds", "0", "/", "247", " + ", "0", "/", "8")),
    "system_specs": _system,
    "tps": _always(
        MISC,
        _fact("Server", "Integrated", " @ ", "1.2", "/", "50.0", " ms"),
        _fact("Packets", "27", " tx, ", "41", " rx"),
    ),
}
"""What writes each entry's facts; the others write nothing, or in a line with priority."""


TOP, PITCH = 2, 9
"""Where a column begins, and the distance from a line to the next. The same distance is left free below a box."""


class PlacedBox(NamedTuple):
    """A box, and the row of GUI pixels of its first line."""

    box: EntryBox
    top: int


class _Column:
    """The boxes that a column holds so far."""

    def __init__(self, rows: int) -> None:
        self.placed: list[PlacedBox] = []
        self.height = TOP
        self._rows = rows

    @property
    def is_full(self) -> bool:
        return self.height >= self._rows

    def add(self, box: EntryBox) -> None:
        self.placed.append(PlacedBox(box, self.height))
        self.height += (box.rows + 1) * PITCH


def box_columns(screen: F3Screen, rows: int) -> tuple[list[PlacedBox], list[PlacedBox]]:
    """Return the boxes of the left and of the right column, from the top, in a window ``rows`` GUI pixels high."""
    left, right = columns = _Column(rows), _Column(rows)
    # Of the lines with priority the first stands left, the second right.
    priority = {"fps": f"{screen.fps} fps T: {screen.fps} (fifo) @60Hz", "game_version": screen.title}
    first = tuple(priority[entry] for entry in screen.shown if entry in priority)
    for column, lines in zip(columns, (first[::2], first[1::2]), strict=True):
        if lines:
            column.add(EntryBox(FIRST, lines=lines))
    waiting = {box.kind.title: box for box in boxes(screen)}
    for column, titles in zip(columns, screen.stood, strict=True):
        _fill(column, waiting, titles)
    for title, box in list(waiting.items()):
        if box.kind.side:
            _fill(left if box.kind.side == "left" else right, waiting, (title,))
    for title in list(waiting):
        _fill(left if left.height < right.height and not left.is_full else right, waiting, (title,))
    return left.placed, right.placed


def _fill(column: _Column, waiting: dict[str, EntryBox], titles: Iterable[str]) -> None:
    """Put the boxes of these titles that are waiting into a column, as long as it isn't full."""
    for title in titles:
        if title in waiting and not column.is_full:
            column.add(waiting.pop(title))


def stood_after(screen: F3Screen, rows: int) -> Stood:
    """Return where the boxes of a screen stood, for the next frame."""
    left, right = (
        [one.box.kind.title for one in column if one.box.kind is not FIRST] for column in box_columns(screen, rows)
    )
    return tuple(left), tuple(right)
