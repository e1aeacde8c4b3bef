"""Random virtual clients to calibrate: realistic versions, windows, latencies, worlds and players."""

from collections.abc import Iterator

import numpy as np

from mc_nested.live.model.versions import draws_text_over_menus
from sim.client.drawing.painter import WORLDS
from sim.client.game.edition import Edition
from sim.client.game.options import GameOptions
from sim.client.settings import ClientSettings, Size, gui_scale

VERSIONS = (
    *("1.12.2", "1.13.2", "1.14.4", "1.15.2", "1.16.1", "1.16.5", "1.17.1", "1.18.2", "1.19.2", "1.19.3", "1.19.4"),
    *(
        "1.20.1",
        "1.20.4",
        "1.20.6",
        "1.21.1",
        "1.21.5",
        "1.21.8",
        "1.21.9",
        "1.21.10",
        "1.21.11",
        "26.1",
        "26.1.2",
        "26.2",
        "26.3",
        "26.4",
    ),
)
"""Each minor version, and of each row of FACTS' tables one or more, from the first with known commands to the last."""

NARROWEST = 480
"""Width in GUI pixels: in a narrower window a block's long tag may cover the Facing line to 1.21.8, and the doctor says
so (FACTS: The F3 debug screen)."""

FLOORS = ("bedrock", "stone", "dirt", "grass_block", "sand")
FACING_ERROR_DEG = 15.0
"""How far from an axis of the world a player may look when facing along it."""


SIZES = ((854, 480), (1280, 720), (1920, 1080), (2560, 1440))
"""Windows that people have."""

RANDOM_SIZES = 3

LEAST_WIDTH = 320
"""GUI pixels: the game's own."""


def every_version(seed: int) -> Iterator[ClientSettings]:
    """Yield each version in each of SIZES and some random ones, all options at their defaults, GUI scale Auto.

    To 1.21.8 the random ones are as wide as the doctor asks for.
    """
    rng = np.random.default_rng(seed)
    for version in VERSIONS:
        narrowest = LEAST_WIDTH if draws_text_over_menus(version) else NARROWEST
        others = [_size_of(rng, narrowest) for _ in range(RANDOM_SIZES)]
        for size in (*SIZES, *others):
            yield ClientSettings(seed=int(rng.integers(2**31)), version=version, size=size, scale=None)


def clients(count: int, seed: int) -> Iterator[ClientSettings]:
    """Yield ``count`` clients, the same for the same seed; all versions are equally frequent."""
    rng = np.random.default_rng(seed)
    rounds = -(-count // len(VERSIONS))
    versions = [version for _ in range(rounds) for version in rng.permutation(VERSIONS)]
    for version in versions[:count]:
        yield _client(rng, str(version))


def _client(rng: np.random.Generator, version: str) -> ClientSettings:
    size, scale = _window(rng)
    x, z = (float(rng.integers(-30_000, 30_000)) + float(rng.uniform(0.2, 0.8)) for _ in range(2))
    edition = Edition(version)
    lowest = -60 if edition.since(1, 18) else 4
    floors = FLOORS if edition.since(1, 13) else tuple(floor for floor in FLOORS if floor != "grass_block")
    return ClientSettings(
        seed=int(rng.integers(2**31)),
        version=version,
        size=size,
        scale=scale,
        world=str(rng.choice([*WORLDS, "bright", "dark"])),
        fps=float(rng.uniform(30, 144)),
        input_latency_s=_latency(rng, 0.002, 0.015, 0.02),
        capture_latency_s=_latency(rng, 0.005, 0.020, 0.02),
        feet=(x, float(rng.integers(lowest, 120)), z),
        yaw=float(rng.choice([0, 90, 180, -90]) + rng.uniform(-FACING_ERROR_DEG, FACING_ERROR_DEG)),
        pitch=float(rng.uniform(10, 60)),
        floor_block=str(rng.choice(floors)),
        mode="creative" if rng.random() < 0.7 else "survival",
        options=GameOptions(pause_on_lost_focus=bool(rng.random() < 0.5)),
        slipperiness=0.6 if rng.random() < 0.8 else float(rng.choice([0.5, 0.7, 0.8])),
        speed=1.0 if rng.random() < 0.8 else float(rng.choice([0.85, 1.2])),
        swaps_sides=bool(rng.random() < 0.2),
    )


def _window(rng: np.random.Generator) -> tuple[tuple[int, int], int]:
    """Return a size, odd or even, and a GUI scale that fits it; 0 is auto."""
    while True:
        size, scale = _size(rng), int(rng.integers(0, 6))
        if size[0] >= NARROWEST * gui_scale(size, scale):
            return size, scale


def _size(rng: np.random.Generator) -> Size:
    return int(rng.integers(640, 2561)), int(rng.integers(480, 1441))


def _size_of(rng: np.random.Generator, narrowest: int) -> Size:
    """Return a window of at least so many GUI pixels of width at GUI scale Auto."""
    while (size := _size(rng))[0] < narrowest * gui_scale(size, 0):
        pass
    return size


def _latency(rng: np.random.Generator, least: float, most: float, spread: float) -> tuple[float, float]:
    """Return the least and the most latency of a client, in seconds."""
    begin = float(rng.uniform(least, most))
    return begin, begin + float(rng.uniform(0.0, spread))
