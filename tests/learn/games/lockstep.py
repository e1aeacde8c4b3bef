"""A learner with games in the simulator, in this process."""

from collections.abc import Callable

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.games.player import play_episode
from mc_nested.learn.preset import Preset
from sim.grid import GridGame

Play = Callable[[EpisodePlan], PlayedEpisode]


def learner_of(
    scenario: Scenario, preset: Preset, *, agent: str = "nested", seed: int = 0, stops: bool = False
) -> GamesTrainer:
    """Return a learner that has learnt nothing yet."""
    return GamesTrainer(scenario, Agent(AGENT_SPECS[agent], [scenario], preset, seed), preset, seed, stops)


def game_of(scenario: Scenario, preset: Preset, agent: str = "nested") -> Play:
    """Return a game that plays plans; its initial networks have another seed than the learner's."""
    player = Agent(AGENT_SPECS[agent], [scenario], preset, seed=99)
    arena = player.view_of(ArenaVectorEnv([ArenaEnv(GridGame(scenario), scenario)]), [scenario])
    return lambda plan: play_episode(arena, plan, player)


def finish(learner: GamesTrainer, play: Play) -> GamesTrainer:
    """Let one game play until the run is finished; each episode is taken before the next one is planned."""
    while not learner.finished:
        assert learner.take(play(learner.plan("only")))
    return learner
