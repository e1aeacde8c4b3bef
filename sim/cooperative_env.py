"""A simulated arena of several builders for PettingZoo."""

from mc_nested.arena.action import Cell
from mc_nested.arena.cooperative.parallel_env import CooperativeEnv
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from sim.team_grid import TeamGrid


def cooperative_env(
    scenario: str | Scenario = "line",
    builders: int = 2,
    starts: tuple[Cell, ...] | None = None,
    render_mode: str | None = None,
) -> CooperativeEnv:
    """Return one simulated arena of a shipped scenario's name, a scenario file, or a Scenario.

    ``starts`` are the builders' start cells, in place of ``builders`` spread ones. ScenarioError if it can't be played.
    """
    loaded = scenario if isinstance(scenario, Scenario) else load_scenario(scenario)
    team = team_of(loaded, builders) if starts is None else Team(loaded, starts)
    return CooperativeEnv(TeamGrid(team), team, render_mode)
