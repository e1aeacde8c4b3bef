"""An order of a moment's play, and a plan for it."""

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import load_preset
from mc_nested.workers.games.messages import GameSetup
from tests.learn.made_experiments import DOT

SETUP = GameSetup("virtual", DOT, "nested", load_preset("model-based"), seed=3)


def new_trainer(setup: GameSetup = SETUP, *, stop_at_optimum: bool = True) -> GamesTrainer:
    agent = Agent(AGENT_SPECS[setup.agent], [setup.scenario], setup.preset, setup.seed)
    return GamesTrainer(setup.scenario, agent, setup.preset, setup.seed, stop_at_optimum)
