"""``mc-nested evaluate``: replay a training's greedy policies."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table
from rich.text import Text

from mc_nested.arrays import Arrays
from mc_nested.cli.options import RunArgument
from mc_nested.errors import RunError
from mc_nested.learn.agents import Agent, view_of
from mc_nested.learn.evaluation import GreedyEpisode, play_greedily
from mc_nested.learn.runs.run_folder import RunFolder
from sim.grid import GridVectorEnv


def evaluate(
    run: RunArgument, as_json: Annotated[bool, typer.Option("--json", help="print one JSON object")] = False
) -> None:
    """Replay the greedy policy of every trial in the simulator and print the scores."""
    folder = RunFolder.open(run)
    episodes = greedy_episodes(folder, load_agent(folder))
    scenario = folder.scenario
    if as_json:
        scores = [episode.score for episode in episodes]
        materials = [episode.material_name(scenario) for episode in episodes]
        steps = [len(episode.actions) for episode in episodes]
        found = {"scenario": scenario.name, "optimum": scenario.optimum, "scores": scores}
        print(json.dumps({**found, "materials": materials, "steps": steps}))
        return
    table = Table("trial", "score", "optimum", "material", "steps", title=Text(f"{scenario.name}, greedy"))
    for trial, episode in enumerate(episodes):
        material = episode.material_name(scenario)
        table.add_row(
            f"{trial}", f"{episode.score:g}", f"{scenario.optimum:g}", Text(material), f"{len(episode.actions)}"
        )
    Console().print(table)


def load_agent(folder: RunFolder) -> Agent:
    """The agent of a training's last checkpoint, every trial, able to act."""
    agent = folder.new_agent(folder.config.trials)
    kept = folder.kept()
    for role, online in agent.online().items():
        online[:] = kept[role]
    return agent


def best_policy(run: Path, wanted: RunFolder) -> Arrays:
    """The networks of that training's best trial, by role, to begin another with; RunError if they don't fit."""
    folder = RunFolder.open(run)
    theirs, ours = folder.new_agent(1), wanted.new_agent(1)
    if (theirs.spec, theirs.sizes) != (ours.spec, ours.sizes):
        raise RunError(
            f"{run}: its {folder.config.agent} agent has other networks than this {wanted.config.agent} agent: take "
            f"the same agent, a preset with the same networks, and a design of as many blocks in an arena as large"
        )
    kept = folder.kept()
    rows = load_agent(folder).rows_of(int(kept["scores"].argmax()))
    return {role: kept[role][rows[role]] for role in theirs.online()}


def greedy_episodes(folder: RunFolder, agent: Agent) -> list[GreedyEpisode]:
    """One greedy episode of every trial in the simulator."""
    env = view_of(agent.spec, GridVectorEnv(folder.scenarios), folder.scenarios)
    return play_greedily(env, folder.scenarios, agent)
