"""``mc-nested scenarios``: the designs, their optimum and their fewest steps."""

import json
from pathlib import Path

import pytest

from tests.cli.running import run
from tests.design_files.written import HUT, picture, sponge


def test_scenarios_lists_the_designs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("scenarios") == 0
    printed = " ".join(capsys.readouterr().out.split())
    for words in (
        "optimum 21 fewest 13 steps",
        "optimum 21 fewest 25 steps",
        "optimum 26 fewest 38 steps; the scripted builder takes 52",
        "blocks 6 materials wood -5, stone +10 optimum 16 fewest 27 steps; the scripted builder takes 27",
        "blocks 40 materials wood -5, stone +10 optimum 50 fewest at most 108 steps, the scripted builder's",
        "part 1 8 blocks: wood -5, stone +10 part 2 8 blocks: wood +10, stone -5 optimum 36 fewest 22 steps; the",
        "blocks 100 materials wood -5, stone +10 optimum 110 fewest at most 107 steps, the scripted builder's",
    ):
        assert words in printed


def test_design_in_parts_is_drawn_and_described_part_by_part(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("scenarios", "flag") == 0
    printed = capsys.readouterr().out
    assert "1 1 1 1" in printed
    assert "1  part 1   2  part 2" in printed
    assert run("scenarios", "flag", "--json") == 0
    (flag,) = json.loads(capsys.readouterr().out)["scenarios"]
    assert [part["worth"] for part in flag["parts"]] == [{"wood": -5, "stone": 10}, {"wood": 10, "stone": -5}]
    assert flag["parts"][0]["cells"][5] == ".....####......"


def test_large_user_design_is_listed_with_an_upper_bound_of_steps(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grid = "\n".join(["...............", "###############", "...............", "###############"] + ["." * 15] * 11)
    material = '[[materials]]\nname = "glass"\np = 0\nblock = "glass"\n'
    (tmp_path / "two.toml").write_text(
        f'name = "two rows"\nstart = [0, 0]\nstep_limit = 99\ndesign = """\n{grid}\n"""\n{material}'
    )
    assert run("scenarios", tmp_path / "two.toml") == 0
    printed = capsys.readouterr().out
    assert "arena      15 x 15 cells" in printed
    assert "fewest     at most 42 steps, the scripted builder's: searched up to 18 blocks" in printed


def test_layers_of_a_schematic_are_listed_and_the_chosen_one_is_drawn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    assert run("scenarios", tmp_path / "hut.schem", "--layer", "1") == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines()[:6] == [
        "hut.schem: 3 of 4 layers have blocks, 0 is the lowest",
        "  layer  blocks      cells  of",
        "      0      11      4 x 3  10 stone, 1 oak_stairs",
        "      1       6      4 x 3  4 stone, 1 oak_stairs, 1 create:shaft",
        "      2       2      2 x 1  2 create:shaft",
        "",
    ]
    assert "hut-1\n" in printed.out
    assert ". . . . . o . . o . . . . . ." in printed.out
    assert ". . . . . o o o o . . . . . ." in printed.out
    assert printed.err == (
        "hut.schem, layer 1: its blocks are built of one material: 4 stone, 1 oak_stairs, 1 create:shaft\n"
    )


def test_lowest_layer_is_drawn_by_default_and_a_picture_has_no_list_of_layers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    (tmp_path / "hut.png").write_bytes(picture(HUT[0]))
    assert run("scenarios", tmp_path / "hut.schem", tmp_path / "hut.png") == 0
    printed = capsys.readouterr()
    assert printed.out.count("blocks     11") == 2
    assert printed.out.count("layers have blocks") == 1
    assert "hut.schem, layer 0: the lowest of 3 layers with blocks, --layer takes another\n" in printed.err


def test_only_the_first_hundred_layers_of_a_tower_are_listed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "tower.schem").write_bytes(sponge([["s"]] * 250))
    assert run("scenarios", tmp_path / "tower.schem") == 0
    printed = capsys.readouterr().out
    assert printed.count("1 stone\n") == 100
    assert "  and 150 more\n" in printed


def test_file_name_with_brackets_is_printed_unchanged(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    drawing = [["ss"], ["cc"]]
    data = sponge(drawing)
    (tmp_path / "[red]x.schem").write_bytes(data)
    assert run("scenarios", tmp_path / "[red]x.schem") == 0
    assert "[red]x.schem: 2 of 2 layers have blocks" in capsys.readouterr().out
