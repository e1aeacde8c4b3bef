"""A rollback to the start of an episode, for one that a mishap ends: nothing is learned from it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.replay import ReplayMark


class EpisodeMemory(Protocol):
    """What remembers past episodes beside the replays: an explorer, an imagination."""

    def state(self) -> Arrays:
        """Everything that later steps depend on, by name."""

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned."""


@dataclass(frozen=True)
class EpisodeRollback:
    """Copies of the networks and of what else updates depend on, and the replays' marks."""

    agent: Arrays
    recorders: Mapping[str, Arrays]
    marks: Mapping[str, ReplayMark]

    @classmethod
    def of(cls, agent: Agent, recorders: Mapping[str, EpisodeMemory]) -> "EpisodeRollback":
        """A copy of their state now."""
        return cls(_copied(agent.state()), {k: _copied(part.state()) for k, part in recorders.items()}, agent.mark())

    def restore(self, agent: Agent, recorders: Mapping[str, EpisodeMemory]) -> None:
        """Put them back into that state."""
        agent.load(self.agent)
        agent.take_back(self.marks)
        for name, recorder in recorders.items():
            recorder.load(self.recorders[name])


def _copied(arrays: Arrays) -> Arrays:
    return {name: array.copy() for name, array in arrays.items()}
