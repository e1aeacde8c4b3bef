"""Opening a backend: the simulator at once; a live game is one arena, whose log goes into the summary."""

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from mc_nested.cli.options import Backend, open_arenas, open_game, played_live
from mc_nested.errors import RunError
from mc_nested.live.action_log import FailureBudget
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from sim.grid import GridVectorEnv
from tests.cli.running import run
from tests.learn.made_experiments import BAR, DOT, scenario_text


class Log:
    def summary(self) -> dict[str, Any]:
        return {"actions": 3}


def test_the_simulator_has_no_window_and_no_log() -> None:
    with open_game(Backend.SIM, None, DOT) as (game, display):
        assert (game.reset(0), display) == ((7, 13), None)
    with open_arenas(Backend.SIM, None, [DOT, BAR]) as (env, log):
        assert isinstance(env, GridVectorEnv)
        assert (env.num_envs, log) == (2, None)


def test_a_live_game_is_one_arena() -> None:
    with pytest.raises(RunError, match="one arena, not 2"), open_arenas(Backend.LIVE, "mine", [DOT, BAR]):
        pass


def test_a_games_log_and_its_failures_are_in_the_summary_and_the_simulators_is_empty() -> None:
    budget = FailureBudget()
    assert played_live(Log(), budget) == {"live": {"actions": 3, **budget.summary()}}
    assert played_live(None, budget) == {}


def test_a_scenario_larger_than_the_calibrated_arena_is_one_line_and_nothing_is_written(
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
