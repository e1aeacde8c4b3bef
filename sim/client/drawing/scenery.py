"""The world behind the text: random pictures of many kinds, bright, dark and noisy."""

import numpy as np

from mc_nested.live.devices import Frame

WORLDS = ("flat", "noise", "grey noise", "blocks", "gradient", "specks")
"""Kinds of worlds that are drawn at random; ``bright`` and ``dark`` are a sky at noon and a night."""

SEEN = "seen"
"""Instead of a random picture: the world that the player sees (world_layer.py)."""


def random_world(rng: np.random.Generator, kind: str, width: int, height: int) -> Frame:
    """A picture (height, width, 3) of one kind of ``WORLDS``, or of ``bright`` or ``dark``."""
    if kind in ("bright", "dark"):
        low, high = (200, 256) if kind == "bright" else (0, 30)
        return _blocks(rng.integers(low, high, (-(-height // 16), -(-width // 16), 3), np.uint8), 16, width, height)
    if kind == "flat":
        return np.full((height, width, 3), rng.integers(0, 256, 3), np.uint8)
    if kind == "noise":
        return rng.integers(0, 256, (height, width, 3), np.uint8)
    if kind == "grey noise":
        return np.repeat(rng.integers(0, 256, (height, width, 1), np.uint8), 3, 2)
    if kind == "gradient":
        slope = np.linspace(rng.integers(0, 256, 3), rng.integers(0, 256, 3), width)
        return np.array(np.broadcast_to(slope, (height, width, 3)), np.uint8)
    size = int(rng.choice([2, 3, 4, 16]))
    coarse = rng.integers(0, 256, (-(-height // size), -(-width // size), 3), np.uint8)
    if kind == "specks":
        coarse = (
            np.where(rng.random((*coarse.shape[:2], 1)) < 0.3, 224, rng.integers(0, 120)).astype(np.uint8).repeat(3, 2)
        )
    return _blocks(coarse, size, width, height)


def _blocks(coarse: Frame, size: int, width: int, height: int) -> Frame:
    return np.ascontiguousarray(coarse.repeat(size, 0).repeat(size, 1)[:height, :width])
