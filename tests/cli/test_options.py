"""Options that several verbs share: scenarios by name and file, layers, and arenas by size."""

import dataclasses
from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import draw_grid
from mc_nested.cli.options import arena_size, named_scenario
from mc_nested.errors import ScenarioError, UserError
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from tests.cli.running import run
from tests.design_files.written import HUT, picture, sponge
from tests.learn.made_experiments import DOT, scenario_text


def test_scenario_larger_than_the_calibrated_arena_is_refused_and_nothing_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    large = dataclasses.replace(DOT, name="large", size=20)
    (tmp_path / "large.toml").write_text(scenario_text(large))
    profile = tmp_path / "mine.toml"
    save_profile(Profile(arena=Arena.around((0, 64, 0), "south")), profile)
    before = sorted(tmp_path.iterdir())
    words = ["train", "--backend", "live", "--scenario", str(tmp_path / "large.toml"), "--profile", str(profile)]
    assert run(*words, "--out", tmp_path / "new") == 2
    assert capsys.readouterr().err == (
        "mc-nested: scenario large needs 20 x 20 cells, and the profile's arena has 15 x 15: run mc-nested calibrate "
        f"arena --size 20 --profile {profile}\n"
    )
    assert sorted(tmp_path.iterdir()) == before


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
    assert run("runs", "evaluate", out) == 0
    assert run("play", out) == 0


def test_layer_together_with_resume_is_refused(hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
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
def test_missing_layer_or_file_is_refused_in_one_line_and_nothing_is_written(
    verb: str, words: list[str], says: str, hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    named = [word.replace("HUT", str(hut)).replace("NONE", str(tmp_path / "none")) for word in words]
    assert run(*verb.split(), *named, "--out", tmp_path / "new") == 2
    expected = says.replace("HUT", str(hut)).replace("NONE", str(tmp_path / "none"))
    assert capsys.readouterr().err == f"mc-nested: {expected}\n"
    assert not (tmp_path / "new").exists()


def test_one_layer_applies_to_several_files_and_each_files_notes_are_printed(
    hut: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "dot.png").write_bytes(picture(HUT[0]))
    assert [named_scenario(str(file), 0).name for file in (hut, tmp_path / "dot.png")] == ["hut-0", "dot"]
    assert [line.partition(":")[0] for line in capsys.readouterr().err.splitlines()] == [
        "hut.schem, layer 0",
        "dot.png",
    ]


def scenario_of(size: int, folder: Path) -> str:
    grid = draw_grid(frozenset({(2, 3)}), size)
    (folder / "own.toml").write_text(
        f'name = "own"\nstart = [0, 0]\nstep_limit = 99\ndesign = """\n{grid}"""\n'
        '[[materials]]\nname = "glass"\np = 0\nblock = "glass"\n'
    )
    return str(folder / "own.toml")


def test_an_arena_to_calibrate_has_15_cells_by_default() -> None:
    assert (arena_size(None, None), arena_size(20, None), arena_size(None, "house")) == (15, 20, 15)


@pytest.mark.parametrize(("size", "needed"), [(5, 15), (15, 15), (24, 24)])
def test_scenario_gets_an_arena_as_large_as_it_needs_and_of_at_least_15_cells(
    size: int, needed: int, tmp_path: Path
) -> None:
    assert arena_size(None, scenario_of(size, tmp_path)) == needed


def test_a_schematics_layer_gets_the_arena_that_its_blocks_need(tmp_path: Path) -> None:
    (tmp_path / "field.schem").write_bytes(sponge([["s"], *[["."]] * 2]))
    (tmp_path / "deep.schem").write_bytes(sponge([["s"] * 20, [*["s"] * 5, *["."] * 15]]))
    assert arena_size(None, str(tmp_path / "field.schem")) == 15
    assert arena_size(None, str(tmp_path / "deep.schem"), 0) == 21
    assert arena_size(None, str(tmp_path / "deep.schem"), 1) == 15


def test_layer_without_a_scenario_is_refused() -> None:
    with pytest.raises(UserError, match="--layer is a layer of a schematic: name its file with --scenario"):
        arena_size(None, None, 2)


def test_size_together_with_a_scenario_or_an_unknown_scenario_is_refused() -> None:
    with pytest.raises(UserError, match="--size and --scenario both say how large the arena is"):
        arena_size(20, "house")
    with pytest.raises(ScenarioError, match="no scenario 'castle'"):
        arena_size(None, "castle")
