"""The colour of a block, in the hotbar and in the world."""

import zlib

from sim.client.game.colours import Colour

_KNOWN: dict[str, Colour] = {
    "bedrock": (85, 85, 85),
    "dirt": (134, 96, 67),
    "glowstone": (231, 190, 105),
    "grass_block": (104, 159, 56),
    "lapis_block": (31, 67, 140),
    "mossy_cobblestone": (110, 118, 95),
    "oak_planks": (176, 142, 86),
    "planks": (176, 142, 86),
    "obsidian": (32, 20, 48),
    "sand": (219, 207, 163),
    "smooth_stone": (160, 160, 160),
    "stone": (125, 125, 125),
}


def block_colour(block: str) -> Colour:
    """The mean colour of a block by its name without a namespace; one that isn't known gets one of its own."""
    if block in _KNOWN:
        return _KNOWN[block]
    shade = zlib.crc32(block.encode())
    return 60 + shade % 120, 60 + (shade >> 8) % 120, 60 + (shade >> 16) % 120
