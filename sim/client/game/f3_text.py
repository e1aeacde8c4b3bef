"""The text of each version's debug screen, line by line (FACTS: The F3 debug screen).

From 1.21.9 on it is made from entries (entry_lines.py), and 26.4 puts it into boxes (f3_layers.py).
"""

from functools import lru_cache
from typing import get_args

from sim.client.game.edition import Layout
from sim.client.game.entry_boxes import EntryBox, box_columns
from sim.client.game.entry_lines import entry_columns
from sim.client.game.f3_screen import EMPTY, F3Screen, Part, TextLine, chunk_of, plain, property_lines, towards

LAYOUTS: tuple[Layout, ...] = get_args(Layout)
"""All of them."""


def both_columns(screen: F3Screen) -> tuple[list[Part], list[Part]]:
    """Return the left and the right column, from the top, in parts."""
    if screen.layout == "standin":
        return _standin_left(screen), [plain("Renderer: three.js r128", ""), *_standin_target(screen)]
    if screen.layout == "1.21.9-26.3":
        return entry_columns(screen)
    if screen.layout == "26.4":
        left, right = box_columns(screen, screen.rows)
        return [_boxed(placed.box) for placed in left], [_boxed(placed.box) for placed in right]
    counts, machine = _counts(screen.layout, screen.title, screen.fps), _machine(screen.layout)
    if screen.reduced:
        x, y, z = screen.block
        return [counts, EMPTY, plain(f"Chunk-relative: {x & 15} {y & 15} {z & 15}")], [machine]
    return (
        [counts, EMPTY, *_position(screen), *_looking(screen)],
        [machine, _graphics(screen.size), _target_group(screen), _fluid_group(screen)],
    )


def _boxed(box: EntryBox) -> Part:
    """Return the text of a box of 26.4, each fact as one text, and the gap below it."""
    facts = (f"{fact.name}: {''.join(text for text, _ in fact.value)}" for fact in box.facts)
    title = (box.kind.title,) if box.kind.title else ()
    return plain(*title, *facts, *box.lines, "")


@lru_cache(16)
def _machine(layout: Layout) -> Part:
    rate = ["Allocation rate: 120MB /s"] if layout == "1.19.3-1.21.8" else []
    return plain(
        *("Java: 21.0.3 64bit", "Mem: 23% 480/2048MB", *rate, "Allocated: 41% 840MB", "", "CPU: 4x AMD Ryzen 5", "")
    )


@lru_cache(16)
def _graphics(size: tuple[int, int]) -> Part:
    return plain("Display: {}x{} (AMD)".format(*size), "AMD Radeon", "4.6 Core Profile", "")


@lru_cache(64)
def _counts(layout: Layout, title: str, fps: int) -> Part:
    rate, limit = f"{fps} fps", f"T: {fps}"
    if layout == "1.8-1.12":
        return plain(
            *(title, f"{rate} (0 chunk updates) {limit} vsync fancy vbo", "C: 118/7225 (s) D: 8, pC: 000"),
            *("E: 1/22, B: 0", "P: 0. T: All: 22", "MultiplayerChunkCache: 841, 841"),
        )
    return plain(
        *(title, f"{rate} {limit} vsync fancy fancy-clouds", "Integrated server @ 4 ms ticks, 12 tx, 700 rx"),
        *("C: 302/7225 (s) D: 8, pC: 000", "E: 1/22, B: 0, SD: 8", "P: 0. T: 22"),
        *("Chunks[C] W: 529, 361 E: 59,38,59", "Chunks[S] W: 3249 E: 59,38,59", "minecraft:overworld FC: 0"),
    )


def _position(screen: F3Screen) -> list[Part]:
    (px, py, pz), (x, y, z), layout = screen.xyz, screen.block, screen.layout
    inside = f"{x & 15} {y & 15} {z & 15}"
    block = f"Block: {x} {y} {z}" + (f" [{inside}]" if layout == "1.19.3-1.21.8" else "")
    chunk = f"Chunk: {inside} in {x >> 4} {y >> 4} {z >> 4}"
    if layout == "1.19.3-1.21.8":
        chunk = f"Chunk: {chunk_of(screen.block)}"
    return [
        plain(f"XYZ: {px:.3f} / {py:.5f} / {pz:.3f}"),
        plain(block, chunk),
        plain(f"Facing: {towards(screen.yaw)} ({screen.yaw:.1f} / {screen.pitch:.1f})"),
        _surroundings(layout),
    ]


@lru_cache(16)
def _surroundings(layout: Layout) -> Part:
    biome = "Biome: Plains" if layout == "1.8-1.12" else "Biome: minecraft:plains"
    return plain("Client Light: 15 (15 sky, 0 block)", biome, "Local Difficulty: 0.00")


def _looking(screen: F3Screen) -> list[Part]:
    parts, block = [], {"1.8-1.12": "Looking at", "1.13-1.15": "Looking at block"}.get(screen.layout)
    if block and screen.target is not None and screen.target.pos is not None:
        parts.append(plain("{}: {} {} {}".format(block, *screen.target.pos)))
    if screen.fluid is not None and screen.layout == "1.13-1.15":
        parts.append(plain("Looking at liquid: {} {} {}".format(*screen.fluid)))
    return parts


def _target_group(screen: F3Screen) -> Part:
    if screen.target is None:
        return ()
    tags = plain(*(f"#{tag}" for tag in screen.tags))
    about = (TextLine(screen.target.id or ""), *property_lines(screen.properties), *tags, TextLine())
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
    return (TextLine(label, underlined=True), *plain("minecraft:water", "level: 8", "#minecraft:water"))


def _standin_left(screen: F3Screen) -> list[Part]:
    (px, py, pz), (x, _, z) = screen.xyz, screen.block
    facing = towards(screen.yaw).replace("Towards", "towards")
    return [
        plain(
            screen.title,
            "E: 1",
            "minecraft:overworld",
            "",
            f"XYZ: {px:.3f} / {py:.3f} / {pz:.3f}",
            f"Chunk: {x % 16} ~ {z % 16} in {x // 16} ~ {z // 16}",
            "Facing (viewer): 3.142 -1.065",
            f"Facing (minecraft): {facing} ({screen.yaw:.1f} {screen.pitch:.1f})",
            "Light: 15 (15 sky)",
            "Biome: minecraft:plains",
            "Day: 0",
        )
    ]


def _standin_target(screen: F3Screen) -> list[Part]:
    if screen.target is None or screen.target.pos is None:
        return []
    x, y, z = screen.target.pos
    return [
        (TextLine(screen.target.id or ""), *property_lines(screen.properties), TextLine(f"Looking at: {x} {y} {z}"))
    ]
