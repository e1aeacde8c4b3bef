"""A game's setup for a moment's play, and a trainer for it."""

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import load_preset
from mc_nested.workers.games.mailbox import GameSetup
from tests.learn.made_experiments import DOT

SETUP = GameSetup("virtual", DOT, "nested", load_preset("model-based"), seed=3)


def new_trainer() -> GamesTrainer:
    agent = Agent(AGENT_SPECS[SETUP.agent], [DOT], SETUP.preset, SETUP.seed)
    return GamesTrainer(DOT, agent, SETUP.preset, SETUP.seed, stop_at_optimum=True)
