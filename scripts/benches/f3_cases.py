"""Random debug screens and worlds behind them, to test a reader on. The same seed gives the same frames."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Block, Reading, Target
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.overlay import SCALES
from scripts.benches.painted_screen import paint
from sim.client.drawing.painter import WORLDS, random_world
from sim.client.game.debug_entries import TUTORIAL, known_entries, shown_entries
from sim.client.game.edition import Edition, Layout
from sim.client.game.f3_screen import BY_ENTRIES, F3Screen
from sim.client.game.f3_text import LAYOUTS

WINDOWS = ((854, 480), (1280, 720), (1366, 768), (1600, 900), (1920, 1080), (2560, 1440))
"""Widths and heights in pixels, wide enough that the two columns don't overlap."""

REACHES = (16, 1_000, 100_000, 29_999_000)
"""How far from the origin players are, in blocks: the last is the world's border."""

ROOMY = 480
"""GUI pixels of width from which on two columns have room for any coordinates."""

_WIDE = 620
"""GUI pixels of width from which on any two columns, and the boxes of 26.4, fit beside each other.

For 26.4 at its default scale all windows are this wide.
"""

_IDS = ("stone", "oak_planks", "oak_log", "grass_block", "dirt", "polished_blackstone_brick_wall", "tnt", "white_wool")
_LONG = 16
"""From this many letters on, an id has no room beside the other column in a narrow window."""

_OLD_IDS = ("stone", "planks", "log", "grass", "stone_brick_stairs", "tnt", "wool")
"""Ids of 1.12, which shows the id in the row of the Facing line."""

_BY_ENTRIES: dict[Layout, tuple[str, ...]] = {
    "1.21.9-26.3": ("1.21.9", "1.21.11", "26.1", "26.2", "26.3"),
    "26.4": ("26.4-snapshot-2", "26.4", "27.1"),
}
_PROPERTIES = (("axis", "y"), ("snowy", "false"), ("waterlogged", "true"), ("facing", "north"))
_TAGS = ("minecraft:planks", "minecraft:mineable/axe", "c:villager_job_sites")


def frames(
    font: Font, seed: int, windows: tuple[tuple[int, int], ...] = WINDOWS, layouts: tuple[Layout, ...] = LAYOUTS
) -> Iterator[tuple[F3Screen, Frame]]:
    """Yield endless screens and their frames: each layout, GUI scale 1 to 8 and window in turn, over random worlds.

    As in the game, a GUI scale that doesn't fit the window becomes the largest that fits (FACTS: The F3 debug screen).
    """
    rng = np.random.default_rng(seed)
    count = 0
    while True:
        layout = layouts[count % len(layouts)]
        width, height = windows[(count // len(layouts)) % len(windows)]
        scale = min(1 + (count // (len(layouts) * len(windows))) % len(SCALES), width // 320, height // 240)
        if layout == "26.4":
            scale = min(scale, max(1, width // _WIDE))
        # Where the columns are near each other, the position and the block looked at share a row.
        reaches = REACHES if -(-width // scale) >= ROOMY else REACHES[:-1]
        screen = random_screen(rng, layout, scale, reaches, has_more=width >= _WIDE * scale)
        yield screen, paint(random_world(rng, WORLDS[int(rng.integers(len(WORLDS)))], width, height), screen, font)
        count += 1


def random_screen(
    rng: np.random.Generator,
    layout: Layout,
    gui_scale: int,
    reaches: tuple[int, ...] = REACHES,
    *,
    has_more: bool = True,
) -> F3Screen:
    """Return a screen with coordinates of one of these reaches, any view, and mostly a target block.

    From 1.21.9 on it may have other entries than the tutorial asks for, unless ``has_more`` is false.
    """
    reach = float(rng.choice(reaches))
    x, z = (float(value) for value in rng.uniform(-reach, reach, 2))
    y = float(rng.uniform(-64, 319))
    near = tuple(int(value) for value in np.floor((x, y, z)) + rng.integers(-4, 5, 3))
    block: Block = (near[0], near[1], near[2])
    target = rng.random() < 0.8
    is_standin, is_old = layout == "standin", layout == "1.8-1.12"
    ids: tuple[str, ...] = _OLD_IDS if is_old else _IDS
    if layout in BY_ENTRIES and not has_more:  # the id and the chunk stand beside each other
        ids = tuple(each for each in ids if len(each) < _LONG)
    name = ids[int(rng.integers(len(ids)))]
    return F3Screen(
        layout,
        gui_scale,
        (x, y, z),
        float(rng.uniform(-180, 180)),
        float(rng.uniform(-90, 90)),
        target=Target(block, name if is_standin else f"minecraft:{name}") if target else None,
        properties=_PROPERTIES[: int(rng.integers(3 if is_standin else 5))],
        tags=() if is_standin or is_old else _TAGS[: int(rng.integers(len(_TAGS) + 1))],
        # A fluid without a block behind it is not read for sure: that block may be covered.
        fluid=block if target and rng.random() < 0.2 else None,
        **(_chosen(rng, layout, block) if has_more else {}),
    )


def _chosen(rng: np.random.Generator, layout: Layout, block: Block) -> dict[str, Any]:
    """Return a version and entries, random ones, for a layout from 1.21.9 on; nothing for an older layout."""
    if layout not in BY_ENTRIES:
        return {}
    version = str(rng.choice(_BY_ENTRIES[layout]))
    known = known_entries(Edition(version))
    asked = shown_entries(TUTORIAL, Edition(version), has_f3=True)
    needed = {"player_position", *(entry for entry in asked if entry.startswith("looking_at_block"))}
    kept = needed if rng.random() < 0.3 else {*needed, *asked}
    more = {entry for entry in known if rng.random() < 0.1}
    return {
        "version": version,
        "entries": tuple(sorted(kept | more)),
        "has_f3": bool(rng.random() < 0.7),
        "entity": (block[0] + 0.5, float(block[1]), block[2] + 0.5) if rng.random() < 0.2 else None,
    }


def expected(screen: F3Screen) -> Reading:
    """Return what a perfect reader reads: the numbers as shown."""
    x, y, z = screen.xyz
    height = round(y, 3 if screen.layout == "standin" else 5)
    return Reading((round(x, 3), height, round(z, 3)), round(screen.yaw, 1), round(screen.pitch, 1), screen.target)
