"""Opening a backend: the simulator at once; a live game is one arena, whose log goes into the summary."""

from typing import Any

import pytest

from mc_nested.cli.options import Backend, open_arenas, open_game, played_live
from mc_nested.errors import RunError
from mc_nested.live.failure_budget import FailureBudget
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT


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
