"""``mc-nested scenarios``: the designs, their optimum and their fewest steps."""

from pathlib import Path

import pytest

from tests.cli.running import run


def test_scenarios_lists_the_designs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("scenarios") == 0
    printed = " ".join(capsys.readouterr().out.split())
    for words in (
        "optimum 21 fewest 13 steps",
        "optimum 21 fewest 25 steps",
        "optimum 26 fewest 38 steps; the scripted builder takes 52",
        "blocks 6 materials wood -5, stone +10 optimum 16 fewest 27 steps; the scripted builder takes 27",
        "blocks 40 materials wood -5, stone +10 optimum 50 fewest at most 108 steps, the scripted builder's",
        "blocks 100 materials wood -5, stone +10 optimum 110 fewest at most 107 steps, the scripted builder's",
    ):
        assert words in printed


def test_a_large_design_of_a_users_own_is_listed_with_an_upper_bound(
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
