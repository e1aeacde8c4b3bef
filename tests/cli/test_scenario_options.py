"""Designs of other programs wherever a scenario is named: training, reproducing, sweeping, resuming."""

from pathlib import Path

import pytest

from mc_nested.cli.scenario_options import named_scenarios
from mc_nested.learn.runs.run_folder import RunFolder
from tests.cli.running import run
from tests.design_files.written import HUT, picture, sponge


@pytest.fixture
def hut(tmp_path: Path) -> Path:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    return tmp_path / "hut.schem"


def test_a_run_keeps_the_whole_design_and_never_needs_the_file_again(
    hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "run"
    assert run("train", "--episodes", "2", "--scenario", hut, "--layer", "1", "--out", out) == 0
    assert "hut.schem, layer 1: its blocks are built of one material" in capsys.readouterr().err
    hut.unlink()
    scenario = RunFolder.open(out).scenario
    assert (scenario.name, scenario.blocks, scenario.start, scenario.step_limit) == ("hut-1", 6, (7, 14), 60)
    assert run("train", "--resume", out) == 0
    assert run("evaluate", out) == 0
    assert run("play", out) == 0


def test_a_layer_beside_resume_is_refused(hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "run"
    assert run("train", "--episodes", "2", "--scenario", hut, "--out", out) == 0
    capsys.readouterr()
    assert run("train", "--resume", out, "--layer", "1") == 2
    assert capsys.readouterr().err == "mc-nested: --resume goes on with the run's own config.toml: leave out --layer\n"


@pytest.mark.parametrize("verb", ["train", "reproduce", "study sweep"])
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--layer", "1"], "line is a drawing of one layer: leave out --layer"),
        (["--scenario", "HUT", "--layer", "9"], "HUT: layer 9 is above its highest: choose 0 to 2"),
        (["--scenario", "NONE.schem"], "NONE.schem: there is no such file: check its name and folder"),
    ],
)
def test_a_layer_that_is_not_there_is_one_line_and_nothing_is_written(
    verb: str, words: list[str], says: str, hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named = [word.replace("HUT", str(hut)).replace("NONE", str(tmp_path / "none")) for word in words]
    assert run(*verb.split(), *named, "--out", tmp_path / "new") == 2
    expected = says.replace("HUT", str(hut)).replace("NONE", str(tmp_path / "none"))
    assert capsys.readouterr().err == f"mc-nested: {expected}\n"
    assert not (tmp_path / "new").exists()


def test_several_files_are_taken_with_one_layer_and_each_ones_notes(
    hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "dot.png").write_bytes(picture(HUT[0]))
    assert [scenario.name for scenario in named_scenarios([str(hut), str(tmp_path / "dot.png")], 0)] == ["hut-0", "dot"]
    assert [line.partition(":")[0] for line in capsys.readouterr().err.splitlines()] == [
        "hut.schem, layer 0",
        "dot.png",
    ]
