"""The debug screen from 1.21.9 to 26.3: two columns made from the entries that are on (FACTS: The F3 debug screen).

An entry writes lines of one of three kinds: one with priority, single ones, or a group's. The first line with priority
stands left, the second right; below, each half of the single lines in its column, then each half of the groups.
"""

from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import NamedTuple, TypeVar

from mc_nested.live.model.reading import Block
from sim.client.game.f3_screen import (
    EMPTY,
    F3Screen,
    Part,
    TextLine,
    chunk_of,
    plain,
    property_lines,
    section_of,
    towards,
)

T = TypeVar("T")

_PRIORITY, _SINGLE = "priority", "single"


class _Said(NamedTuple):
    """The lines that an entry writes, in parts, and the group that they belong to."""

    group: str
    parts: tuple[Part, ...]


def entry_columns(screen: F3Screen) -> tuple[list[Part], list[Part]]:
    """Return the left and the right column, from the top, in parts."""
    said: dict[str, list[Part]] = {_PRIORITY: [], _SINGLE: []}
    for entry in screen.shown:
        if entry in _ENTRIES:
            group, parts = _ENTRIES[entry](screen)
            # A group counts even while it has no lines.
            said.setdefault(group, []).extend(parts)
    first = said.pop(_PRIORITY)
    singles: list[Part] = [(line,) for part in said.pop(_SINGLE) for line in part]
    half, groups = _halves(singles), _halves(list(said.values()))
    left, right = (
        [*_apart(first[side::2]), *_apart(half[side]), *(part for group in groups[side] for part in _apart(group))]
        for side in (0, 1)
    )
    return left + ([EMPTY, _help(screen)] if screen.shown and screen.has_f3 else []), right


def _apart(parts: list[Part]) -> list[Part]:
    """Return the lines with an empty row below, if there are any lines."""
    return [*parts, EMPTY] if parts else []


def _halves(items: list[T]) -> tuple[list[T], list[T]]:
    middle = (len(items) + 1) // 2
    return items[:middle], items[middle:]


def _single(*texts: str) -> Callable[[F3Screen], _Said]:
    return _group(_SINGLE, *texts)


def _group(name: str, *texts: str) -> Callable[[F3Screen], _Said]:
    said = _Said(name, (plain(*texts),))
    return lambda _: said


def _help(screen: F3Screen) -> Part:
    return _helping(*(screen.edition.since(*since) for since in ((1, 21, 11), (26, 1), (26, 3))))


@lru_cache(8)
def _helping(has_keys: bool, has_light: bool, is_small: bool) -> Part:
    """Return the lines that help with the charts and F3+F6, in a world without a screen over it."""
    fps = "fps + tps" if is_small else "FPS + TPS"
    charts = f"Debug charts: [F3+1] Profiler hidden; [F3+2] {fps} hidden; [F3+3] Ping hidden"
    if not has_keys:
        return plain(charts, "To edit: press F3 + F6. For help: press F3 + Q")
    lines = charts.replace("; [F3+3]", ";\n[F3+3]").split("\n") if has_light else [charts]
    return plain(*lines[:-1], lines[-1] + ("; [F3+4] Lightmap hidden" if has_light else ""), "To edit: press [F3+F6]")


def _fps(screen: F3Screen) -> _Said:
    sync = "(fifo) @60Hz" if screen.edition.since(26, 3) else "vsync"
    return _Said(_PRIORITY, (plain(f"{screen.fps} fps T: {screen.fps} {sync}"),))


def _version(screen: F3Screen) -> _Said:
    return _Said(_PRIORITY, (plain(screen.title),))


def _impactors(screen: F3Screen) -> _Said:
    if not screen.edition.since(1, 21, 11):
        return _Said(_SINGLE, (plain("fancy fancy-clouds B: 2"),))
    return _Said(_SINGLE, (plain(" fancy-clouds B: 2", "Filtering: RGSS"),))


def _memory(screen: F3Screen) -> _Said:
    return _Said("memory", (_used("MiB" if screen.edition.since(26, 1) else "MB"),))


@lru_cache(2)
def _used(unit: str) -> Part:
    return plain(f"Mem: 23% 480/2048{unit}", f"Allocation rate: 035{unit}/s", f"Allocated: 41% 840{unit}")


def _system(screen: F3Screen) -> _Said:
    return _Said("system", (_specs(screen.size),))


@lru_cache(16)
def _specs(size: tuple[int, int]) -> Part:
    return plain(
        *("Java: 25.0.2", "CPU: 4x AMD Ryzen 5", "Display: {}x{} (AMD)".format(*size)),
        *("AMD Radeon", "OpenGL 3.3.0 Core Profile"),
    )


def _position(screen: F3Screen) -> _Said:
    (px, py, pz), (x, y, z) = screen.xyz, screen.block
    parts = (
        plain(f"XYZ: {px:.3f} / {py:.5f} / {pz:.3f}"),
        plain(f"Block: {x} {y} {z}", f"Chunk: {chunk_of(screen.block)}"),
        plain(f"Facing: {towards(screen.yaw)} ({screen.yaw:.1f} / {screen.pitch:.1f})"),
        _OVERWORLD,
    )
    return _Said("position", parts)


_OVERWORLD = plain("minecraft:overworld FC: 0")


def _section(screen: F3Screen) -> _Said:
    return _Said("position", (plain(f"Section-relative: {section_of(screen.block)}"),))


def _block(screen: F3Screen) -> _Said:
    if screen.target is None or screen.target.pos is None:
        return _Said("looking_at_block", ())
    # To 1.21.11 the tags belong to the same entry.
    tags = () if screen.edition.since(26, 1) else screen.tags
    named = _targeted("Block", screen.target.pos, screen.target.id or "", screen.properties)
    return _Said("looking_at_block", ((*named, *_tagged(tags)),))


def _block_tags(screen: F3Screen) -> _Said:
    return _Said("looking_at_block", (_tagged(screen.tags),) if screen.target and screen.tags else ())


def _fluid(screen: F3Screen) -> _Said:
    if screen.fluid is None:
        return _Said("looking_at_fluid", ())
    tags = () if screen.edition.since(26, 1) else ("minecraft:water",)
    named = _targeted("Fluid", screen.fluid, "minecraft:water", (("falling", "false"), ("level", "8")))
    return _Said("looking_at_fluid", ((*named, *_tagged(tags)),))


def _fluid_tags(screen: F3Screen) -> _Said:
    return _Said("looking_at_fluid", (_tagged(("minecraft:water",)),) if screen.fluid else ())


def _entity(screen: F3Screen) -> _Said:
    part = (TextLine("Targeted Entity", underlined=True), TextLine("minecraft:pig"))
    return _Said("looking_at_entity", (part,) if screen.entity else ())


def _targeted(kind: str, pos: Block, name: str, properties: Iterable[tuple[str, str]]) -> Part:
    x, y, z = pos
    heading = TextLine(f"Targeted {kind}: {x}, {y}, {z}", underlined=True)
    return (heading, TextLine(name), *property_lines(properties))


def _tagged(tags: Iterable[str]) -> Part:
    return plain(*(f"#{tag}" for tag in tags))


_ENTRIES: dict[str, Callable[[F3Screen], _Said]] = {
    "biome": _single("Biome: minecraft:plains"),
    "chunk_generation_stats": _group("chunk_generation", "NoiseRouter T: 0.512", "Biome builder PV: Low"),
    "chunk_render_stats": _single("C: 302/7225 (s) D: 8, pC: 000, pU: 00, aB: 11"),
    "chunk_source_stats": _single("Chunks[C] W: 529, 361 E: 59,38,59", "Chunks[S] W: 3249 E: 59,38,59"),
    "day_count": _single("Day: 3"),
    "entity_render_stats": _single("E: 1/22, SD: 8"),
    "entity_spawn_counts": _single("SC: 289, M: 17, C: 10, A: 8, A: 5, U: 0, W: 20, W: 60"),
    "fps": _fps,
    "game_version": _version,
    "gpu_utilization": _single("GPU: 23%"),
    "heightmap": _group("heightmaps", "CH S: 63 M: 63", "SH S: 63 O: 63 M: 63 ML: 63"),
    "light_levels": _group("light", "Client Light: 15 (15 sky, 0 block)"),
    "local_difficulty": _single("Local Difficulty: 2.25 // 0.05"),
    "looking_at_block": _block,
    "looking_at_block_state": _block,
    "looking_at_block_tags": _block_tags,
    "looking_at_entity": _entity,
    "looking_at_fluid": _fluid,
    "looking_at_fluid_state": _fluid,
    "looking_at_fluid_tags": _fluid_tags,
    "memory": _memory,
    "particle_render_stats": _single("P: 22"),
    "player_position": _position,
    "player_section_position": _section,
    "simple_performance_impactors": _impactors,
    "sound_mood": _single("Sounds: 0/247 + 0/8 (Mood 0%)"),
    "system_specs": _system,
    "tps": _single("Integrated server @ 1.2/50.0 ms, 27 tx, 41 rx"),
}
"""What writes each entry's lines; the others write nothing."""
