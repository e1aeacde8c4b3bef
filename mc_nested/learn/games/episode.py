"""What goes to a game, a planned episode, and what comes back, the episode as it was played: data, to be pickled."""

from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from mc_nested.arrays import Float32s, Float64s, Int64s
from mc_nested.learn.imagination.first_tries import FirstTries


@dataclass(frozen=True)
class EpisodePlan:
    """All that a game needs to play one episode by itself.

    Args:
        number: counts the learner's plans, from 0.
        process: names the learner's process: one that resumes its training may give a number again.
        material: the main agent's choice; 0 where there is no main agent.
        greedy: whether it is an evaluation.
        online: the online network of the agent that builds, (parameters,).
        epsilon: its ε.
        numbers: uniform numbers in [0, 1) for its choices, (steps, 2), steps being the most of an episode; (0, 2)
            where it plays without ε.
        first_tries: what it tries before it does what its network says (first_tries.py); None if nothing.
    """

    number: int
    process: int
    material: int
    greedy: bool
    online: Float32s
    epsilon: float
    numbers: Float64s
    first_tries: FirstTries | None


@dataclass(frozen=True)
class PlayedEpisode:
    """A whole episode, every step of which was confirmed.

    Args:
        number: its plan's.
        process: its plan's.
        observations: what the agent saw, from the reset on, (steps + 1, …).
        actions: what it did, of its own set of actions, (steps,).
        rewards: r_N of each step, (steps,).
        terminated: whether its last step terminated it; it was truncated otherwise.
        score: r_M.
    """

    number: int
    process: int
    observations: NDArray[Any]
    actions: Int64s
    rewards: Float64s
    terminated: bool
    score: float

    @property
    def steps(self) -> int:
        """How many steps it took."""
        return len(self.actions)
