"""Pictures: which pixels are blocks, in every kind of PNG, and what is refused before it is unpacked."""

import io
import struct
import tracemalloc
import zlib

import numpy as np
import pytest
from PIL import Image

from mc_nested.design_files.png import SIGNATURE, read_picture
from mc_nested.errors import ScenarioError
from tests.design_files.written import HUT, picture

SHAPE = [[character != "." for character in row] for row in HUT[0]]


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def header(width: int, height: int) -> bytes:
    return SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))


@pytest.mark.parametrize("mode", ["RGBA", "RGB", "P", "L", "LA", "1"])
def test_every_kind_of_png_shows_the_same_drawing(mode: str) -> None:
    volume = read_picture(picture(HUT[0], mode))
    assert (volume.layers, volume.filled(0).tolist()) == (1, SHAPE)


def test_a_grey_picture_of_16_bits_shows_the_same_drawing() -> None:
    file = io.BytesIO()
    Image.fromarray(np.where(SHAPE, 0x4EFF, 0xFFFF).astype(np.uint16)).save(file, "PNG")
    assert read_picture(file.getvalue()).filled(0).tolist() == SHAPE


@pytest.mark.parametrize(
    ("pixel", "is_block"),
    [
        ((0, 0, 0, 255), True),
        ((0, 0, 0, 128), True),
        ((0, 0, 0, 127), False),
        ((240, 240, 240, 255), False),
        ((255, 255, 239, 255), True),
        ((255, 255, 255, 0), False),
    ],
)
def test_a_pixel_is_a_block_unless_it_is_transparent_or_white(pixel: tuple[int, ...], is_block: bool) -> None:
    file = io.BytesIO()
    Image.fromarray(np.array([[pixel]], np.uint8)).save(file, "PNG")
    assert read_picture(file.getvalue()).filled(0).tolist() == [[is_block]]


def test_each_colour_is_a_kind_of_block() -> None:
    assert dict(read_picture(picture(HUT[0])).kinds(0)) == {"#5a5a5a": 10, "#966e3c": 1}


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "it is no PNG picture"),
        (b"\xff\xd8\xff a JPEG", "it is no PNG picture"),
        (SIGNATURE, "it is no PNG picture"),
        (header(1025, 1), "it has 1025 x 1 pixels, and a pixel is a cell: draw it smaller"),
        (header(2**31, 2**31), "pixels, and a pixel is a cell"),
        (header(0, 0) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b""), "damaged, or ends in the middle"),
        (header(4, 4), "damaged, or ends in the middle"),
        (picture(HUT[0])[:-40], "damaged, or ends in the middle"),
    ],
)
def test_a_file_that_is_not_a_whole_small_picture_is_refused(data: bytes, says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_picture(data)


def test_a_picture_that_unpacks_to_far_more_than_its_size_is_not_unpacked() -> None:
    bomb = header(4, 4) + chunk(b"zTXt", b"k\0\0" + zlib.compress(bytes(50_000_000)))
    bomb += chunk(b"IDAT", zlib.compress(bytes(50_000_000))) + chunk(b"IEND", b"")
    tracemalloc.start()
    try:
        with pytest.raises(ScenarioError, match="damaged"):
            read_picture(bomb)
        assert tracemalloc.get_traced_memory()[1] < 5_000_000
    finally:
        tracemalloc.stop()
