"""Messages between a learner and a game: the training to play for, and the game's answer."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.episode import PlayedEpisode
from mc_nested.learn.preset import Preset


@dataclass(frozen=True)
class GameSetup:
    """What is played for a training: in which kind of game, what is built, and by whom.

    Args:
        backend: live, or virtual for games on the virtual client.
        scenario: what is built.
        agent: the agent's name.
        preset: its hyper-parameters.
        seed: the training's.
    """

    backend: str
    scenario: Scenario
    agent: str
    preset: Preset
    seed: int

    def new_agent(self) -> Agent:
        """Return an agent of one run, to play with the networks that a plan brings."""
        return Agent(AGENT_SPECS[self.agent], [self.scenario], self.preset, self.seed)


class GameAnswer(NamedTuple):
    """What came of a request.

    Args:
        episode: as it was played and confirmed; None where none was asked for, or it came to nothing.
        problem: why it came to nothing, in a line; empty where it didn't, or the game stands ready.
        is_refusal: whether this game can't play such a setup at all.
        leaves: whether this game won't play any more.
        log: what playing took so far, for a summary.
    """

    episode: PlayedEpisode | None = None
    problem: str = ""
    is_refusal: bool = False
    leaves: bool = False
    log: Mapping[str, Any] = {}
