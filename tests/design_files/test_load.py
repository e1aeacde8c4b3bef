"""Any scenario by its name or file: the content decides the format, a layer is chosen, mistakes are one line."""

import gzip
import os
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.design_files.load import chosen_layer, is_design_file, load_any_scenario, ranges, read_volume
from mc_nested.design_files.nbt import MOST_BYTES
from mc_nested.design_files.volume import Volume
from mc_nested.errors import ScenarioError, with_extra
from tests.design_files.written import HUT, NAMES, WRITERS, Drawing, cells, nbt_file, picture, sponge

Write = Callable[[str, bytes], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def written(name: str, data: bytes) -> Path:
        (tmp_path / name).write_bytes(data)
        return tmp_path / name

    return written


def names_in(volume: Volume) -> list[str]:
    return [volume.palette[number] for number in volume.blocks.reshape(-1).tolist()]


def names_of(drawing: Drawing, name: str) -> list[str]:
    """Return the names of the drawing's blocks, as the reader of a file of that name gives them."""
    others = {"c": "block number 300"} if name.startswith("mcedit") else {}
    return [{**NAMES, **others}[character] for character in cells(drawing)]


BEDROCK = (
    b"\x0a\0\0\x03\x0e\0format_version\x01\0\0\0\x09\x04\0size\x03\x03\0\0\0\x04\0\0\0\x04\0\0\0\x03\0\0\0"
    b"\x09\x16\0structure_world_origin\x03\x03\0\0\0" + bytes(12) + b"\0"
)
"""A structure of Bedrock Edition without its blocks: each number's lowest byte first."""


@pytest.mark.parametrize("name", WRITERS)
def test_every_format_is_read_to_the_same_blocks(name: str, write: Write) -> None:
    volume = read_volume(write(name, WRITERS[name](HUT)))
    assert volume.blocks.shape == (4, 3, 4)
    assert names_in(volume) == names_of(HUT, name)


@st.composite
def drawings(draw: st.DrawFn) -> Drawing:
    width, height, length = (draw(st.integers(1, 6)) for _ in range(3))
    row = st.text("...soowc", min_size=width, max_size=width)
    return draw(st.lists(st.lists(row, min_size=length, max_size=length), min_size=height, max_size=height))


@given(drawings(), st.sampled_from(list(WRITERS)))
def test_any_drawing_is_read_as_it_was_written(
    tmp_path_factory: pytest.TempPathFactory, drawing: Drawing, name: str
) -> None:
    path = tmp_path_factory.getbasetemp() / name
    path.write_bytes(WRITERS[name](drawing))
    assert names_in(read_volume(path)) == names_of(drawing, name)


def test_the_content_decides_the_format_and_not_the_ending(write: Write) -> None:
    for name in ("hut.schematic", "hut.NBT", "hut.litematic"):
        assert names_in(read_volume(write(name, sponge(HUT)))) == names_of(HUT, "hut.schem")


def test_other_names_are_shipped_scenarios_or_toml_files() -> None:
    assert load_any_scenario("zigzag").scenario == load_scenario("zigzag")
    assert not is_design_file("house.toml")
    assert is_design_file("My House.PNG")
    with pytest.raises(ScenarioError, match="no scenario 'castle': name one of line"):
        load_any_scenario("castle")
    with pytest.raises(ScenarioError, match="line is a drawing of one layer: leave out --layer"):
        load_any_scenario("line", 0)


def test_the_lowest_layer_with_blocks_is_taken_and_reported(write: Write) -> None:
    path = write("hut.schem", sponge([["...."] * 3, *HUT]))
    loaded = load_any_scenario(path)
    assert loaded.scenario.name == "hut-1"
    assert loaded.scenario.blocks == 11
    assert loaded.notes == (
        "hut.schem, layer 1: the lowest of 3 layers with blocks, --layer takes another",
        "hut.schem, layer 1: its blocks are built of one material: 10 stone, 1 oak_stairs",
    )


def test_a_named_layer_is_taken_without_a_note(write: Write) -> None:
    path = write("hut.schem", sponge(HUT))
    loaded = load_any_scenario(path, 2)
    assert (loaded.scenario.name, loaded.scenario.blocks, loaded.notes) == ("hut-2", 2, ())
    assert load_any_scenario(path, 2, must_choose=True) == loaded


def test_a_file_with_one_layer_of_blocks_needs_no_choice(write: Write) -> None:
    path = write("bar.schem", sponge([["...."], ["ss.s"], ["...."]]))
    assert load_any_scenario(path, must_choose=True).scenario.name == "bar-1"
    assert load_any_scenario(write("dot.png", picture(HUT[0])), must_choose=True).scenario.name == "dot"


@pytest.mark.parametrize(
    ("layer", "must_choose", "says"),
    [
        (3, False, "layer 3 has no block: choose 0 to 2"),
        (4, False, "layer 4 is above its highest: choose 0 to 2"),
        (None, True, "3 of its layers have blocks, and only one can be built: name it with --layer, 0 to 2"),
    ],
)
def test_a_layer_that_can_not_be_taken_is_refused(
    layer: int | None, must_choose: bool, says: str, write: Write
) -> None:
    path = write("hut.schem", sponge(HUT))
    with pytest.raises(ScenarioError) as caught:
        load_any_scenario(path, layer, must_choose=must_choose)
    assert str(caught.value) == f"{path}: {says}"


def test_a_volume_without_blocks_is_refused() -> None:
    with pytest.raises(ScenarioError, match="it has no block"):
        chosen_layer(Volume(("air",), np.zeros((2, 1, 1), np.int32)), None)


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ([4], "4"),
        ([0, 1, 2], "0 to 2"),
        ([0, 2], "0 or 2"),
        ([0, 1, 4, 7, 8], "0 to 1, 4 or 7 to 8"),
        (list(range(0, 40, 2)), "0, 2, 4, 6, 8 or others up to 38"),
    ],
)
def test_layer_numbers_are_listed_in_words(numbers: list[int], words: str) -> None:
    assert ranges(numbers) == words


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("hut.schem", nbt_file({"Data": b"", "Level": 3}), "it is NBT, but no schematic of a known kind: save it as"),
        ("hut.schem", b"name = 'hut'", "it is no schematic, neither compressed with gzip nor plain NBT"),
        ("hut.schem", picture(HUT[0]), "it is no schematic, neither compressed with gzip nor plain NBT"),
        ("hut.png", sponge(HUT), "it is no PNG picture: save it as PNG"),
        ("hut.nbt", sponge(HUT)[:90], "it ends in the middle: copy, or download, it again"),
        ("hut.schem", b"", "it is empty: save, or download, it again"),
        ("hut.png", b"", "it is empty"),
        ("hut.mcstructure", BEDROCK, "it is a structure of Minecraft Bedrock Edition: import it in the Amulet editor"),
        ("hut.nbt", BEDROCK, "it is a structure of Minecraft Bedrock Edition"),
        ("hut.schem", gzip.compress(BEDROCK, mtime=0), "it is a structure of Minecraft Bedrock Edition"),
        ("HUT.MCSTRUCTURE", b"whatever", "it is a structure of Minecraft Bedrock Edition"),
    ],
)
def test_an_unusable_file_is_refused_in_one_line_that_names_the_file(
    name: str, data: bytes, says: str, write: Write
) -> None:
    path = write(name, data)
    with pytest.raises(ScenarioError) as caught:
        load_any_scenario(path)
    assert str(caught.value).startswith(f"{path}: {says}")
    assert "\n" not in str(caught.value)


def test_a_missing_file_a_folder_and_a_too_large_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "folder.schem").mkdir()
    with (tmp_path / "large.schem").open("wb") as file:
        file.truncate(MOST_BYTES + 1)
    for name, says in (("none", "there is no such file"), ("folder", "there is no such"), ("large", "than 32 MB")):
        with pytest.raises(ScenarioError, match=says):
            read_volume(tmp_path / f"{name}.schem")


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read everything")
def test_a_file_without_permission_to_read_is_refused(write: Write) -> None:
    path = write("hut.schem", sponge(HUT))
    path.chmod(0)
    with pytest.raises(ScenarioError, match="it can't be read, Permission denied: name another file"):
        read_volume(path)


def test_a_schematic_without_pynbt_is_refused_with_the_install_command(
    write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pynbt", None)
    with pytest.raises(ScenarioError) as refused:
        read_volume(write("hut.schem", sponge(HUT)))
    assert str(refused.value).endswith(f"hut.schem: reading schematics needs pynbt: {with_extra('schematics')}")
    assert load_any_scenario(write("hut.png", picture(HUT[0]))).scenario.blocks
