"""Files made to exhaust a machine, and honest ones of a million blocks: each in a process whose memory is measured."""

import gzip
import io
import re
import struct
import subprocess
import sys
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from mc_nested.design_files.png import SIGNATURE
from tests.design_files.written import Longs, Short, litematic, named, nbt_file, payload, sponge, states

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="Windows doesn't say how much memory a process took"),
]

MOST_MB, MOST_S = 800, 30
"""Memory that reading a file may take beyond the program's own, and seconds of processor time."""

READ = """
import resource, sys, time
from pathlib import Path
from mc_nested.design_files import litematic, load, png
from mc_nested.errors import ScenarioError

def megabytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)

before, began = megabytes(), time.process_time()
try:
    said = f"{load.load_any_scenario(sys.argv[1]).scenario.blocks} blocks"
except ScenarioError as error:
    said = str(error)
print(megabytes() - before, time.process_time() - began, said)
"""

ROOT = b"\x0a\0\0"


def structure(blocks: int) -> bytes:
    """Return a structure with so many blocks, row by row of 48."""
    head = named("", {"size": [48, blocks // 2304 + 1, 48], "palette": states(["minecraft:stone"])})[:-1]
    places = ([at % 48, at // 2304, at // 48 % 48] for at in range(blocks))
    entries = b"".join(payload({"pos": place, "state": 0}) for place in places)
    return gzip.compress(head + b"\x09\0\6blocks" + struct.pack(">bi", 10, blocks) + entries + b"\0", 1)


def noise() -> bytes:
    file = io.BytesIO()
    pixels = np.random.default_rng(0).integers(0, 256, (1024, 1024, 3), dtype=np.uint8)
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def picture_bomb() -> bytes:
    chunks = (
        (b"IHDR", struct.pack(">IIBBBBB", 1024, 1024, 16, 6, 0, 0, 0)),
        (b"zTXt", b"k\0\0" + zlib.compress(bytes(2**28))),
        (b"IDAT", zlib.compress(bytes(2**28))),
    )
    whole = (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks
    )
    return SIGNATURE + b"".join(whole)


def list_of(kind: int, length: int) -> bytes:
    return gzip.compress(ROOT + b"\x09\0\6blocks" + struct.pack(">bi", kind, length) + bytes(30_000_001), 1)


def of_two_byte_numbers() -> bytes:
    sizes = {"Version": 2, "Width": Short(256), "Height": Short(128), "Length": Short(256)}
    return nbt_file(
        {**sizes, "Palette": {"minecraft:air": 0, "minecraft:stone": 1000}, "BlockData": b"\xe8\x07" * 2**23}
    )


def tower() -> bytes:
    region = {"Position": {"x": 0, "y": 0, "z": 0}, "Size": {"x": 1, "y": 2**23, "z": 1}}
    blocks = {"BlockStatePalette": states(["air", "stone"]), "BlockStates": Longs([0x5555555555555555] * 2**18)}
    return litematic({"tower": {**region, **blocks}})


FILES: dict[str, tuple[Callable[[], bytes], str]] = {
    "million.schem": (lambda: sponge([["s" * 100] * 100] * 100), "992 blocks"),
    "eight million of two bytes.schem": (of_two_byte_numbers, "992 blocks"),
    "eight million layers.litematic": (tower, "1 blocks"),
    "the game's largest.nbt": (lambda: structure(48**3), "992 blocks"),
    "twice as large.nbt": (lambda: structure(2 * 48**3), "it lists 221,184 blocks"),
    "million.nbt": (lambda: structure(10**6), "it unpacks to more than 32 MB"),
    "noise.png": (noise, "992 blocks"),
    "bomb.schem": (lambda: gzip.compress(ROOT + bytes(2**29), 1), "it unpacks to more than 32 MB"),
    "bomb.png": (picture_bomb, "the picture is damaged"),
    "nested.schem": (lambda: gzip.compress(ROOT * 10_000_000, 1), "its values lie nested too deeply"),
    "empty compounds.nbt": (lambda: list_of(10, 30_000_000), "it lists 30,000,000 blocks"),
    "empty lists.nbt": (lambda: list_of(9, 6_000_000), "it holds more values than any design"),
    "bytes.nbt": (lambda: list_of(1, 30_000_000), "it holds more values than any design"),
}
"""How each file is made, and what is said of it."""


@pytest.mark.parametrize("name", FILES)
def test_a_large_file_is_read_or_refused_with_little_memory(name: str, tmp_path: Path) -> None:
    make, says = FILES[name]
    (tmp_path / name).write_bytes(make())
    done = subprocess.run(
        [sys.executable, "-c", READ, str(tmp_path / name)], capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr
    took = re.match(r"(\S+) (\S+) (.*)", done.stdout)
    assert took
    assert says in took[3]
    assert float(took[1]) < MOST_MB
    assert float(took[2]) < MOST_S
