"""A PNG that says that it is huge, and is."""

import struct
import zlib


def png_of_nothing(width: int, height: int) -> bytes:
    """Return a transparent PNG of that size, itself small."""
    rows = height * (1 + 4 * width)
    part = bytes(1 << 20)
    packer = zlib.compressobj(9)
    begin = packer.compress(part) + packer.flush(zlib.Z_FULL_FLUSH)
    again = packer.compress(part) + packer.flush(zlib.Z_FULL_FLUSH)
    end = zlib.compressobj(9, wbits=-15)
    tail = end.compress(bytes(rows % len(part))) + end.flush()
    checksum = struct.pack(">HH", rows % 65521, 1)  # Adler-32 of so many zeros
    packed = begin + again * (rows // len(part) - 1) + tail + checksum
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunks = (b"IHDR", header), (b"IDAT", packed), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)) for name, data in chunks
    )
