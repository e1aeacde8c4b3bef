"""A schematic that is too large is refused by the size that it states, in any format and any order of its tags."""

import gzip
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from mc_nested.design_files.load import read_volume
from mc_nested.design_files.nbt import read_nbt
from mc_nested.design_files.sponge import read_sponge
from mc_nested.design_files.stated_size import SMALL_BYTES, check_stated_size
from mc_nested.design_files.volume import MOST_CELLS
from mc_nested.errors import ScenarioError
from tests.design_files.written import Longs, Short, named, nbt_file, states

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
def test_it_takes_less_than_a_second(name: str, is_size_last: bool, tmp_path: Path) -> None:
    tags, says = LARGE[name]
    root = in_order(tags, is_size_last=is_size_last)
    data = named("", {"Regions": {"one": root}} if name.endswith("litematic") else root)
    (tmp_path / name).write_bytes(gzip.compress(data, 1))
    began = time.process_time()
    with pytest.raises(ScenarioError, match=says):
        read_volume(tmp_path / name)
    assert time.process_time() - began < MOST_S


def test_the_message_is_that_of_decoding_it() -> None:
    root = {**WIDE, "Version": 2, "Palette": {"a": 0}, "BlockData": bytes(SMALL_BYTES)}
    said = []
    for refuse in (lambda: check_stated_size(named("", root)), lambda: read_sponge(read_nbt(nbt_file(root)))):
        with pytest.raises(ScenarioError) as caught:
            refuse()
        said.append(str(caught.value))
    assert said[0] == said[1]


def test_one_of_the_largest_size_is_let_pass_and_so_is_one_that_states_none() -> None:
    rest = {"filler": bytes(SMALL_BYTES)}
    check_stated_size(named("", {**rest, "size": [256, MOST_CELLS // 256**2, 256]}))
    check_stated_size(named("", {**rest, "size": [-1, -1, -(2**31)]}))
    check_stated_size(named("", {**rest, "Width": Short(65535), "Height": Short(65535)}))
    check_stated_size(named("", {**rest, "Size": {"x": 9000, "y": 9000, "w": 9000}}))
    check_stated_size(named("", rest))
    with pytest.raises(ScenarioError):
        check_stated_size(named("", {**rest, "size": [256, MOST_CELLS // 256**2 + 1, 256]}))


def test_a_small_file_is_left_to_its_reader() -> None:
    check_stated_size(named("", {"size": [4000, 4000, 4000]}))
