"""A job's trainer, before its first tick."""

from typing import Any

from gymnasium.vector import VectorEnv

from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arrays import Int64s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.builders import Builders
from mc_nested.learn.trainer import Trainer
from mc_nested.studies.job import Job


def team_of_job(job: Job) -> Team | None:
    """Return the builders who share an arena in each of its runs, all of one scenario; None where one builds alone."""
    return team_of(job.scenarios[0], job.builders.count) if job.builders else None


def agents_trainer(job: Job, env: VectorEnv[Int64s, Int64s, Any]) -> Trainer:
    """Return the trainer of a job; ``env`` has the arena of each of its runs, as the simulator makes them."""
    team = team_of_job(job)
    builders = Builders(team.starts, job.builders.networks) if team and job.builders else None
    spec = AGENT_SPECS[builders.agent] if builders else job.spec
    agent = Agent(spec, job.scenarios, job.preset, job.seed, job.trials, builders)
    view = agent.view_of(env, job.scenarios)
    return Trainer(view, job.scenarios, agent, job.preset, job.seed, job.stop_at_optimum)
