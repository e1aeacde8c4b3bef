"""An order of a moment's play, and a plan for it."""

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import load_preset
from mc_nested.workers.games.order import GameOrder
from tests.learn.made_experiments import DOT

ORDER = GameOrder("virtual", DOT, "nested", load_preset("model-based"), seed=3)


def new_trainer() -> GamesTrainer:
    agent = Agent(AGENT_SPECS[ORDER.agent], [DOT], ORDER.preset, ORDER.seed)
    return GamesTrainer(DOT, agent, ORDER.preset, ORDER.seed, stop_at_optimum=True)
