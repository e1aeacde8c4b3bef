"""How large an arena is calibrated: a number, a scenario's, or the default."""

from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import draw_grid
from mc_nested.cli.arena_options import arena_size
from mc_nested.errors import ScenarioError, UserError
from tests.design_files.written import sponge


def scenario_of(size: int, folder: Path) -> str:
    grid = draw_grid(frozenset({(2, 3)}), size)
    (folder / "own.toml").write_text(
        f'name = "own"\nstart = [0, 0]\nstep_limit = 99\ndesign = """\n{grid}"""\n'
        '[[materials]]\nname = "glass"\np = 0\nblock = "glass"\n'
    )
    return str(folder / "own.toml")


def test_it_is_15_cells_unless_something_else_is_said() -> None:
    assert (arena_size(None, None), arena_size(20, None), arena_size(None, "house")) == (15, 20, 15)


@pytest.mark.parametrize(("size", "needed"), [(5, 15), (15, 15), (24, 24)])
def test_a_scenario_gets_what_it_needs_and_never_less_than_the_papers(size: int, needed: int, tmp_path: Path) -> None:
    assert arena_size(None, scenario_of(size, tmp_path)) == needed


def test_a_schematics_layer_gets_the_arena_that_its_blocks_need(tmp_path: Path) -> None:
    (tmp_path / "field.schem").write_bytes(sponge([["s"], *[["."]] * 2]))
    (tmp_path / "deep.schem").write_bytes(sponge([["s"] * 20, [*["s"] * 5, *["."] * 15]]))
    assert arena_size(None, str(tmp_path / "field.schem")) == 15
    assert arena_size(None, str(tmp_path / "deep.schem"), 0) == 21
    assert arena_size(None, str(tmp_path / "deep.schem"), 1) == 15


def test_a_layer_without_a_scenario_is_one_line() -> None:
    with pytest.raises(UserError, match="--layer is a layer of a schematic: name its file with --scenario"):
        arena_size(None, None, 2)


def test_a_size_beside_a_scenario_or_a_scenario_that_is_none_is_one_line() -> None:
    with pytest.raises(UserError, match="--size and --scenario both say how large the arena is"):
        arena_size(20, "house")
    with pytest.raises(ScenarioError, match="no scenario 'castle'"):
        arena_size(None, "castle")
