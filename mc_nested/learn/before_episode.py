"""What an agent knew before an episode, so that one that a mishap spoils can be taken back: it is never learnt from."""

from dataclasses import dataclass

from mc_nested.learn.agents import Agent
from mc_nested.learn.checkpoint import Arrays
from mc_nested.learn.scouts import Scouts


@dataclass(frozen=True)
class BeforeEpisode:
    """Copies of the networks and of what else updates depend on, and how many transitions were remembered."""

    agent: Arrays
    scouts: Arrays
    marks: Arrays

    @classmethod
    def of(cls, agent: Agent, scouts: Scouts | None) -> "BeforeEpisode":
        """What they know now."""
        return cls(_copied(agent.state()), _copied(scouts.state() if scouts else {}), agent.marks())

    def bring_back(self, agent: Agent, scouts: Scouts | None) -> None:
        """Make them know that again, and nothing of what came since."""
        agent.load(self.agent)
        agent.forget_since(self.marks)
        if scouts:
            scouts.load(self.scouts)


def _copied(arrays: Arrays) -> Arrays:
    return {name: array.copy() for name, array in arrays.items()}
