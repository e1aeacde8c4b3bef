"""What a training's own player says of its playing, for the summary."""

from typing import Any

from mc_nested.cli.training_loop import OwnPlayer
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.live.action_log import FailureBudget
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import DOT


class Log:
    def summary(self) -> dict[str, Any]:
        return {"actions": 3}


def test_summary_has_a_live_games_log_and_failures_and_nothing_of_the_simulator() -> None:
    budget, preset, arenas = FailureBudget(), load_preset("paper"), GridVectorEnv([DOT])
    trainer = Trainer(arenas, [DOT], Agent(AGENT_SPECS["nested"], [DOT], preset, 0), preset, 0)

    def summary(log: Log | None) -> dict[str, Any]:
        return OwnPlayer(trainer, arenas, log, lambda: False, budget).summary()

    assert summary(Log()) == {"live": {"actions": 3, **budget.summary()}}
    assert summary(None) == {}
