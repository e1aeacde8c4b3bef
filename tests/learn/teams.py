"""Small trainings of several builders."""

from collections.abc import Sequence

from mc_nested.arena.cooperative.team import team_of
from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.builders import Builders, Networks
from mc_nested.learn.preset import Preset
from mc_nested.learn.trainer import Trainer
from sim.team_grid import TeamGrid
from tests.learn.made_trainings import PAPER, SHORT

LINE = load_scenario("line")


def agent_of(
    networks: Networks, builders: int, runs: Sequence[int] = (0, 1), preset: Preset = PAPER, seed: int = 0
) -> Agent:
    team = Builders(team_of(LINE, builders).starts, networks)
    return Agent(AGENT_SPECS[team.agent], [LINE] * len(runs), preset, seed, runs, team)


def arenas_of(builders: int, runs: int) -> TeamVectorEnv:
    team = team_of(LINE, builders)
    return TeamVectorEnv([TeamGrid(team) for _ in range(runs)], team)


def trainer_of(
    networks: Networks, builders: int, runs: Sequence[int] = (0, 1), preset: Preset = SHORT, seed: int = 0
) -> Trainer:
    agent, scenarios = agent_of(networks, builders, runs, preset, seed), [LINE] * len(runs)
    arenas = agent.view_of(arenas_of(builders, len(runs)), scenarios)
    return Trainer(arenas, scenarios, agent, preset, seed)
