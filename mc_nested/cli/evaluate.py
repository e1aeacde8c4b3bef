"""``mc-nested evaluate``: replay a training's greedy policies."""

from rich.table import Table
from rich.text import Text

from mc_nested.cli.options import RunArgument
from mc_nested.cli.output import JsonOption, Output
from mc_nested.cli.own_player import simulated_team
from mc_nested.cli.screen_states import check_window
from mc_nested.learn.agents import Agent
from mc_nested.learn.evaluation import GreedyEpisode, play_greedily
from mc_nested.learn.runs.run_folder import RunFolder
from sim.grid import GridVectorEnv


def evaluate(run: RunArgument, as_json: JsonOption = False) -> None:
    """Replay the greedy policy of every trial in the simulator and print the scores."""
    folder = RunFolder.open(run)
    episodes = greedy_episodes(folder, load_agent(folder))
    scenario = folder.scenario
    found = {
        "folder": folder.path,
        "scenario": scenario.name,
        "optimum": scenario.optimum,
        "scores": [episode.score for episode in episodes],
        "materials": [episode.material_name(scenario) for episode in episodes],
        "steps": [len(episode.actions) for episode in episodes],
    }
    table = Table("trial", "score", "optimum", "material", "steps", title=Text(f"{scenario.name}, greedy"))
    for trial, episode in enumerate(episodes):
        material = episode.material_name(scenario)
        table.add_row(
            f"{trial}", f"{episode.score:g}", f"{scenario.optimum:g}", Text(material), f"{len(episode.actions)}"
        )
    Output(as_json=as_json).result(found, table)


def load_agent(folder: RunFolder) -> Agent:
    """The agent of a training's last checkpoint, every trial, able to act."""
    agent = folder.new_agent(folder.config.trials)
    kept = folder.policies()
    agent.load_online(kept)
    return agent


def greedy_episodes(folder: RunFolder, agent: Agent) -> list[GreedyEpisode]:
    """One greedy episode of every trial in the simulator; UserError if it sees what the simulator can't show."""
    check_window(folder.config.preset.states, has_window=False)
    arenas = simulated_team(folder, folder.config.trials) or GridVectorEnv(folder.scenarios)
    env = agent.view_of(arenas, folder.scenarios)
    return play_greedily(env, folder.scenarios, agent)
