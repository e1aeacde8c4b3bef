"""The steps of a calibration, and the order in which they are run."""

from pathlib import Path

import pytest

from calibration.calibrate_all import CalibrationStep, registered_steps
from calibration.font.sources import FontSources
from mc_nested.arena.action import Cell
from mc_nested.errors import FontError, UserError
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_over, font_file_in, profile_in, started


def step(steps: list[CalibrationStep], name: str) -> CalibrationStep:
    (found,) = [step for step in steps if step.name == name]
    return found


def test_steps_are_font_arena_walk_clicks_cross_check_and_proof_in_this_order() -> None:
    assert [step.name for step in registered_steps()] == ["font", "arena", "walk", "clicks", "cross-check", "proof"]


def test_only_the_clicks_and_cross_check_steps_may_fail_without_ending_the_run() -> None:
    assert [step.name for step in registered_steps() if not step.is_needed] == ["clicks", "cross-check"]


@pytest.mark.parametrize("cell", [(-1, 0), (0, -1), (15, 0), (0, 15), (99, 99)])
def test_a_cell_outside_the_arena_is_refused_before_anything_is_run(cell: Cell) -> None:
    with pytest.raises(UserError, match="outside the arena: choose 0 to 14"):
        registered_steps(standing=cell)


@pytest.mark.parametrize("cell", [(0, 0), (14, 14)])
def test_player_may_stand_on_a_corner_of_the_arena(cell: Cell) -> None:
    assert len(registered_steps(standing=cell)) == 6


def test_larger_arena_has_its_own_corners_and_a_size_above_32_is_refused() -> None:
    assert len(registered_steps(size=32, standing=(31, 31))) == 6
    assert len(registered_steps(size=32)) == 6
    with pytest.raises(UserError, match="outside the arena: choose 0 to 31"):
        registered_steps(size=32, standing=(32, 0))
    with pytest.raises(UserError, match="choose 15 to 32 cells along each side"):
        registered_steps(size=33)


def test_arena_step_builds_an_arena_of_the_given_size(tmp_path: Path) -> None:
    client = started(VirtualClient(pitch=65.0))
    profile = profile_in(tmp_path)
    found = step(registered_steps(size=17), "arena").run(context_over(client), profile)
    assert found.profile.marked_arena().size == 17
    assert client.cell(found.profile.marked_arena()) == (8, 0)


def test_font_step_takes_the_given_font_and_looks_for_no_other(tmp_path: Path) -> None:
    font = font_file_in(tmp_path)
    steps = registered_steps(font, lambda _: pytest.fail("it looked for fonts"))
    found = step(steps, "font").run(context_over(started(VirtualClient(pitch=65.0))), Profile())
    assert found.profile.screen.font == str(font)


def test_font_step_asks_its_sources_for_the_version_in_the_window_title() -> None:
    asked: list[str | None] = []

    def sources(version: str | None) -> FontSources:
        asked.append(version)
        return FontSources(())

    client = started(VirtualClient(version="1.20.1", pitch=65.0))
    with pytest.raises(FontError, match="no client jar of the game can be used"):
        step(registered_steps(sources=sources), "font").run(context_over(client), Profile())
    assert asked == ["1.20.1"]


def test_the_arena_step_marks_the_arena_around_the_cell_that_the_player_stands_on(tmp_path: Path) -> None:
    client = started(VirtualClient(pitch=65.0))
    file = tmp_path / "mine.toml"
    profile = profile_in(tmp_path)
    save_profile(profile, file)
    found = step(registered_steps(standing=(3, 2), path=file), "arena").run(context_over(client), profile)
    assert found.profile.arena is not None
    assert client.cell(found.profile.arena) == (3, 2)
