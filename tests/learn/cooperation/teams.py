"""Small trainings of a team."""

from collections.abc import Sequence

from mc_nested.arena.cooperative.single_team import SingleTeamEnv
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.cooperative.team_env import TeamEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.cooperation.team_agent import Kind, TeamAgent
from mc_nested.learn.cooperation.team_trainer import TeamTrainer
from mc_nested.learn.preset import Preset, load_preset
from sim.team_grid import TeamGrid

LINE = load_scenario("line")
PAPER = load_preset("paper")
SHORT = PAPER.model_copy(
    update={
        "episodes": 20,
        "evaluate_every": 5,
        "update": PAPER.update.model_copy(update={"batch": 8, "learning_starts": 16, "target_period": 50}),
    }
)


def arena_of(kind: Kind, team: Team) -> TeamEnv | SingleTeamEnv:
    env = TeamEnv(TeamGrid(team), team)
    return SingleTeamEnv(env) if kind == "single" else env


def trainer_of(
    kind: Kind, builders: int, runs: Sequence[int] = (0, 1), preset: Preset = SHORT, seed: int = 0
) -> TeamTrainer:
    team = team_of(LINE, builders)
    agent = TeamAgent(kind, team, preset, seed, runs)
    return TeamTrainer([arena_of(kind, team) for _ in runs], agent, preset, seed)


def finish(trainer: TeamTrainer) -> TeamTrainer:
    while not trainer.finished:
        trainer.tick()
    return trainer
