"""An episode that a game plays: as the learner plans it, and as the game played it.

Both are data, to be pickled: neither needs Numba or an engine (player.py plays them).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from mc_nested.arena.action import Cell
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


@dataclass(frozen=True)
class EpisodeOut:
    """A planned episode, and what the learner has to know when it is back.

    Args:
        plan: what is played.
        game: the game that plays it.
        episodes: training episodes that the learner had completed.
        epsilons: the main and the nested agent's ε.
        probes: unknown cells where it should place blocks.
        online: of an evaluation all networks that it was planned with, by role; otherwise nothing.
    """

    plan: EpisodePlan
    game: str
    episodes: int
    epsilons: tuple[float, float]
    probes: frozenset[Cell]
    online: Mapping[str, NDArray[Any]]


class EpisodesOut:
    """The episodes that are out, by number; of each game one at most."""

    def __init__(self) -> None:
        self._out: dict[int, EpisodeOut] = {}

    def __len__(self) -> int:
        return len(self._out)

    def add(self, episode: EpisodeOut) -> None:
        """Add an episode that is out."""
        self._out[episode.plan.number] = episode

    def leave(self, game: str) -> None:
        """Forget what that game had out: it won't come."""
        self._out = {number: out for number, out in self._out.items() if out.game != game}

    def remove(self, number: int) -> EpisodeOut | None:
        """Return the episode of that number, which isn't out any more; None if it wasn't."""
        return self._out.pop(number, None)

    def clear(self) -> None:
        """Forget all episodes: none is out any more."""
        self._out = {}

    def keep_evaluations(self) -> None:
        """Forget the training episodes: they aren't out any more."""
        self._out = {number: out for number, out in self._out.items() if out.plan.greedy}

    def supersede(self, episodes: int) -> None:
        """Forget evaluations that were planned after fewer training episodes than that: they aren't out any more."""
        self._out = {n: out for n, out in self._out.items() if not out.plan.greedy or out.episodes >= episodes}

    @property
    def newest_evaluation(self) -> int:
        """The training episodes after which the last of the evaluations was planned; -1 if there is none."""
        return max((out.episodes for out in self._out.values() if out.plan.greedy), default=-1)

    @property
    def probes(self) -> frozenset[Cell]:
        """The unknown cells where they should place blocks."""
        return frozenset[Cell]().union(*(out.probes for out in self._out.values()))

    @property
    def materials(self) -> frozenset[int]:
        """The materials that they play."""
        return frozenset(out.plan.material for out in self._out.values())
