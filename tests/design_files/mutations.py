"""Damaged copies of files: bytes flipped, cut off, repeated, and lengths that no file has."""

import gzip
import random
import struct

HOSTILE = (-1, -5, -(2**31), 2**31 - 1, 2**16, 10**6)
"""Four-byte numbers where a length, a size or a position was."""

GZIP = b"\x1f\x8b"


def mutated(data: bytes, random: random.Random) -> bytes:
    """Return a damaged copy. Of a compressed file, mostly what is in it is damaged, and it is compressed again."""
    if data.startswith(GZIP) and random.random() < 0.8:
        return gzip.compress(_damaged(gzip.decompress(data), random), 1, mtime=0)
    return _damaged(data, random)


def _damaged(data: bytes, random: random.Random) -> bytes:
    damaged = bytearray(data)
    for _ in range(random.choice((1, 1, 1, 2, 5))):
        at = random.randrange(len(damaged)) if damaged else 0
        kind = random.randrange(7)
        if kind == 0:
            damaged[at : at + 1] = bytes([random.randrange(256)])
        elif kind == 1:
            damaged[at : at + 1] = bytes([random.choice((0, 1, 0x7F, 0x80, 0xFF))])
        elif kind == 2:
            damaged[at : at + 4] = struct.pack(">i", random.choice(HOSTILE))
        elif kind == 3:
            damaged[at : at + 2] = random.choice((b"\xff\xff", b"\x7f\xff", b"\x00\x00"))
        elif kind == 4:
            del damaged[at:]
        elif kind == 5:
            del damaged[at : at + random.randrange(1, 20)]
        else:
            damaged[at:at] = damaged[at : at + random.randrange(1, 50)]
    return bytes(damaged)
