"""An order of a moment's play, and a plan for it."""

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import load_preset
from mc_nested.workers.games.order import GameOrder
from tests.learn.made_experiments import DOT

ORDER = GameOrder("virtual", DOT, "nested", load_preset("model-based"), seed=3)


def new_trainer(order: GameOrder = ORDER, *, stop_at_optimum: bool = True) -> GamesTrainer:
    agent = Agent(AGENT_SPECS[order.agent], [order.scenario], order.preset, order.seed)
    return GamesTrainer(order.scenario, agent, order.preset, order.seed, stop_at_optimum)
