"""Pictures (.png): a pixel is a cell, the top row lies farthest away.

A pixel is free if it is transparent (less than half opaque) or white (red, green and blue at least 240 of 255). Any
other is a block, whatever its colour.
"""

import io
import struct

import numpy as np
from PIL import Image

from mc_nested.design_files.volume import AIR, Volume
from mc_nested.errors import ScenarioError

MOST_PIXELS_A_SIDE = 1024

OPAQUE_FROM, WHITE_FROM = 128, 240

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_picture(data: bytes) -> Volume:
    """Return the picture as one layer, each colour a kind of block.

    Raise ScenarioError, without the file's name, if it is none.
    """
    if not data.startswith(SIGNATURE) or len(data) < 24:
        raise ScenarioError("it is no PNG picture: save it as PNG")
    width, height = struct.unpack(">II", data[16:24])
    if max(width, height) > MOST_PIXELS_A_SIDE:
        raise ScenarioError(
            f"it has {width} x {height} pixels, and a pixel is a cell: draw it smaller, an arena has at most 32 x 32"
        )
    try:
        with Image.open(io.BytesIO(data), formats=["PNG"]) as image:
            pixels = np.asarray(_of_8_bits(image).convert("RGBA"))
    except (OSError, SyntaxError, ValueError, EOFError, struct.error) as error:
        raise ScenarioError("the picture is damaged, or ends in the middle: save it again as PNG") from error
    red, green, blue, alpha = (pixels[..., channel].astype(np.int32) for channel in range(4))
    free = (alpha < OPAQUE_FROM) | ((red >= WHITE_FROM) & (green >= WHITE_FROM) & (blue >= WHITE_FROM))
    colours, blocks = np.unique(np.where(free, -1, red << 16 | green << 8 | blue), return_inverse=True)
    names = [AIR if colour < 0 else f"#{colour:06x}" for colour in colours.tolist()]
    return Volume(tuple(names), blocks.reshape(1, *free.shape))


def _of_8_bits(image: Image.Image) -> Image.Image:
    """Return the same picture; a grey one of 16 bits, which Pillow would make white, with the higher eight."""
    if not image.mode.startswith("I"):
        return image
    return Image.fromarray((np.asarray(image).astype(np.int32) >> 8).astype(np.uint8))
