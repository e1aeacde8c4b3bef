"""A rollback to the start of an episode, for one that a mishap ends: nothing is learned from it."""

from collections.abc import Mapping
from dataclasses import dataclass

from mc_nested.arrays import Arrays
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.replay import ReplayMark
from mc_nested.learn.exploration.batched_return_then_explore import BatchedReturnThenExplore


@dataclass(frozen=True)
class EpisodeRollback:
    """Copies of the networks and of what else updates depend on, and the replays' marks."""

    agent: Arrays
    explorer: Arrays
    marks: Mapping[str, ReplayMark]

    @classmethod
    def of(cls, agent: Agent, explorer: BatchedReturnThenExplore | None) -> "EpisodeRollback":
        """A copy of their state now."""
        return cls(_copied(agent.state()), _copied(explorer.state() if explorer else {}), agent.mark())

    def restore(self, agent: Agent, explorer: BatchedReturnThenExplore | None) -> None:
        """Put them back into that state."""
        agent.load(self.agent)
        agent.take_back(self.marks)
        if explorer:
            explorer.load(self.explorer)


def _copied(arrays: Arrays) -> Arrays:
    return {name: array.copy() for name, array in arrays.items()}
