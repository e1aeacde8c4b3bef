"""An arena in the simulator, for tests of what is made of arenas."""

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from sim.grid import GridGame


def arena_env(scenario: str | Scenario = "line", render_mode: str | None = None) -> ArenaEnv:
    """Return one simulated arena of a shipped scenario's name, a scenario file, or a Scenario."""
    loaded = scenario if isinstance(scenario, Scenario) else load_scenario(scenario)
    return ArenaEnv(GridGame(loaded), loaded, render_mode)
