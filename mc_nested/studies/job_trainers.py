"""A job's trainer, before its first tick: of agents in arenas of their own, or of a team in each arena."""

from collections.abc import Callable, Sequence
from typing import Any

from gymnasium.vector import VectorEnv

from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arrays import Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.cooperation.team_agent import Kind, TeamAgent
from mc_nested.learn.cooperation.team_trainer import TeamArena, TeamTrainer
from mc_nested.learn.trainer import Trainer
from mc_nested.studies.job import Job

TeamArenas = Callable[[Team, Kind, int], Sequence[TeamArena]]
"""Makes so many arenas for a team whose builders learn in that way."""


def agents_trainer(job: Job, env: VectorEnv[Int64s, Int64s, Any]) -> Trainer:
    """Return the trainer of a job of agents; ``env`` has an arena for each of its runs, as the simulator makes them."""
    agent = Agent(job.spec, job.scenarios, job.preset, job.seed, job.trials)
    view = agent.view_of(env, job.scenarios)
    return Trainer(view, job.scenarios, agent, job.preset, job.seed, job.stop_at_optimum)


def team_trainer(job: Job, arenas: TeamArenas) -> TeamTrainer:
    """Return the trainer of a job of builders, who share an arena in each of its runs; all runs have one scenario.

    ValueError if it is no such job.
    """
    if job.builders is None:
        raise ValueError(f"job {job.name} has no builders")
    team = team_of(job.scenarios[0], job.builders.count)
    agent = TeamAgent(job.builders.networks, team, job.preset, job.seed, job.trials)
    return TeamTrainer(arenas(team, job.builders.networks, len(job.trials)), agent, job.preset, job.seed)
