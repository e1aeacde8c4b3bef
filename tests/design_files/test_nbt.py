"""NBT that means harm: nothing is unpacked, allocated or nested beyond its limit, and every refusal is one line.

A schematic that is too large is refused by the size that it states, in any format and any order of its tags.
"""

import gzip
import struct
import time
import tracemalloc
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pynbt
import pytest

from mc_nested.design_files.load import read_volume
from mc_nested.design_files.nbt import MOST_BYTES, SMALL_BYTES, check_stated_size, checked, unpacked, value_of
from mc_nested.design_files.schematic import read_sponge
from mc_nested.design_files.volume import MOST_CELLS
from mc_nested.errors import ScenarioError
from tests.design_files.written import Longs, Short, named, nbt_file, read_nbt, states

ROOT = b"\x0a\0\0"
"""How the root begins: a compound without a name."""


def list_of(kind: int, length: int) -> bytes:
    return b"\x09\0\1a" + struct.pack(">bi", kind, length)


def test_compressed_and_plain_nbt_are_read_alike() -> None:
    plain = named("", {"a": 7, "b": "hut"})
    for data in (plain, gzip.compress(plain)):
        root = read_nbt(data)
        assert (value_of(root, "a", int), value_of(root, "b", str)) == (7, "hut")


def test_a_text_longer_than_pynbts_signed_length_is_read() -> None:
    assert len(value_of(read_nbt(nbt_file({"a": "x" * 40_000, "b": 1})), "a", str)) == 40_000


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "it is no schematic, neither compressed with gzip nor plain NBT"),
        (b"name = 'line'", "it is no schematic"),
        (b"PK\3\4 a zip file", "it is no schematic"),
        (b"\x1f\x8b", "it ends in the middle"),
        (gzip.compress(named("", {"a": 7}), mtime=0)[:-9], "it ends in the middle"),
        (b"\x1f\x8b\x08\0\0\0\0\0\0\3garbage that nobody packed", "gzip can't unpack it"),
        (gzip.compress(named("", {"a": 7}), mtime=0)[:-8] + b"\0" * 8, "gzip can't unpack it"),
        (named("", {"a": 7})[:-2], "it ends in the middle of a value"),
        (b"\x0a", "it ends in the middle of a value"),
        (ROOT + b"\x0d\0\1a\0", "its NBT can't be read"),
        (ROOT + b"\x08\0\1a\0\1\xe0\0", "its NBT can't be read"),
        (gzip.compress(b"an old text", mtime=0), "its NBT can't be read"),
    ],
)
def test_damaged_or_other_data_is_refused(data: bytes, says: str) -> None:
    with pytest.raises(ScenarioError, match=says):
        read_nbt(data)


@pytest.mark.parametrize("kind", [7, 11, 12])
@pytest.mark.parametrize("length", [2**31 - 1, -1, -5, -(2**31), 10**6])
def test_an_arrays_false_length_is_refused(kind: int, length: int) -> None:
    data = ROOT + bytes([kind]) + b"\0\1a" + struct.pack(">i", length) + b"\0" * 200
    tracemalloc.start()
    try:
        with pytest.raises(ScenarioError):
            read_nbt(data)
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("kind", range(13))
@pytest.mark.parametrize("length", [2**31 - 1, 10**6])
def test_a_lists_false_length_is_refused(kind: int, length: int) -> None:
    with pytest.raises(ScenarioError):
        read_nbt(ROOT + list_of(kind, length) + b"\0" * 50)


def test_a_list_of_a_negative_length_is_empty() -> None:
    assert value_of(read_nbt(ROOT + list_of(10, -7) + b"\0"), "a", list) == []


@pytest.mark.parametrize("data", [b"\x0a\0\0" * 100_000, ROOT + list_of(9, 1) + b"\x09\0\0\0\1" * 100_000])
def test_too_deeply_nested_data_is_refused_at_once(data: bytes) -> None:
    began = time.process_time()
    with pytest.raises(ScenarioError, match="its values lie nested too deeply"):
        read_nbt(gzip.compress(data, 1))
    assert time.process_time() - began < 1


def test_a_file_that_unpacks_to_more_than_the_limit_is_not_unpacked_further() -> None:
    bomb = gzip.compress(b"\0" * 2**20, 9) * 200  # parts of gzip's follow one another as one file
    tracemalloc.start()
    try:
        with pytest.raises(ScenarioError, match="it unpacks to more than 32 MB"):
            unpacked(bomb)
        assert tracemalloc.get_traced_memory()[1] < 3 * MOST_BYTES
    finally:
        tracemalloc.stop()


def test_reading_stops_after_the_highest_allowed_number_of_values() -> None:
    values = ROOT + list_of(10, 1000) + b"\0" * 1001
    reads = 3 + 4 + 1000 + 1  # the root's type and name; the list's, with its length; each compound's end; the root's
    assert len(value_of(read_nbt(values, reads), "a", list)) == 1000
    with pytest.raises(ScenarioError, match="it holds more values than any design"):
        read_nbt(values, reads - 1)


def test_a_value_that_is_missing_or_of_another_type_is_refused_by_name() -> None:
    root = read_nbt(nbt_file({"Width": "wide", "Blocks": b"\0"}))
    with pytest.raises(ScenarioError, match=r"^Width is not a whole number: the file is damaged"):
        value_of(root, "Width", int)
    with pytest.raises(ScenarioError, match=r"^Height is missing: the file is damaged"):
        value_of(root, "Height", int)
    assert value_of(root, "Blocks", bytearray) == b"\0"
    with pytest.raises(ScenarioError, match=r"^pos is not a list"):
        checked(pynbt.TAG_Int(3), list, "pos")


MOST_S = 1.0

WIDE = {"Width": Short(400), "Height": Short(150), "Length": Short(400)}
PLACE = {"pos": [1, 2, 3], "state": 0}


def in_order(tags: Mapping[str, Any], *, is_size_last: bool) -> dict[str, Any]:
    return dict(reversed(list(tags.items()))) if is_size_last else dict(tags)


def corner(x: int, y: int, z: int) -> dict[str, int]:
    return {"z": z, "x": x, "y": y}


LARGE: dict[str, Any] = {
    "a.schem": (
        {**WIDE, "Version": 2, "Palette": {"minecraft:air": 0}, "BlockData": bytes(24_000_000)},
        "400 x 150 x 400",
    ),
    "a.schematic": ({**WIDE, "Blocks": bytes(1_000_000), "Data": bytes(1_000_000)}, "400 x 150 x 400"),
    "a.nbt": ({"size": [400, 300, 400], "palette": states(["a"]), "blocks": [PLACE] * 120_000}, "400 x 300 x 400"),
    "b.nbt": ({"size": [48, 48, 48], "palette": states(["a"]), "blocks": [PLACE] * 300_000}, "lists 300,000 blocks"),
    "a.litematic": (
        {"Size": corner(-500, 200, -500), "Position": corner(0, 0, 0), "BlockStates": Longs([0] * 500_000)},
        "500 x 200 x 500",
    ),
}


@pytest.mark.parametrize("is_size_last", [False, True])
@pytest.mark.parametrize("name", LARGE)
def test_a_too_large_size_is_refused_in_less_than_a_second(name: str, is_size_last: bool, tmp_path: Path) -> None:
    tags, says = LARGE[name]
    root = in_order(tags, is_size_last=is_size_last)
    data = named("", {"Regions": {"one": root}} if name.endswith("litematic") else root)
    (tmp_path / name).write_bytes(gzip.compress(data, 1))
    began = time.process_time()
    with pytest.raises(ScenarioError, match=says):
        read_volume(tmp_path / name)
    assert time.process_time() - began < MOST_S


def test_a_too_large_stated_size_is_refused_with_the_readers_own_message() -> None:
    root = {**WIDE, "Version": 2, "Palette": {"a": 0}, "BlockData": bytes(SMALL_BYTES)}
    said = []
    for refuse in (lambda: check_stated_size(named("", root)), lambda: read_sponge(read_nbt(nbt_file(root)))):
        with pytest.raises(ScenarioError) as caught:
            refuse()
        said.append(str(caught.value))
    assert said[0] == said[1]


def test_the_largest_size_and_a_file_without_a_valid_size_pass() -> None:
    rest = {"filler": bytes(SMALL_BYTES)}
    check_stated_size(named("", {**rest, "size": [256, MOST_CELLS // 256**2, 256]}))
    check_stated_size(named("", {**rest, "size": [-1, -1, -(2**31)]}))
    check_stated_size(named("", {**rest, "Width": Short(65535), "Height": Short(65535)}))
    check_stated_size(named("", {**rest, "Size": {"x": 9000, "y": 9000, "w": 9000}}))
    check_stated_size(named("", rest))
    with pytest.raises(ScenarioError):
        check_stated_size(named("", {**rest, "size": [256, MOST_CELLS // 256**2 + 1, 256]}))


def test_the_stated_size_of_a_small_file_is_not_checked() -> None:
    check_stated_size(named("", {"size": [4000, 4000, 4000]}))
