"""What one run has seen of its real game, episode by episode: the learnt game is made of nothing else."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Float64s, Int64s

RECENT = 100
"""Episodes that are remembered: older ones no longer count, so that a change of the game is unlearnt."""

UNTOLD = -1
"""In place of whether a step was paid: it was, or wasn't, by another design."""


class RealStep(NamedTuple):
    """One transition of the real game: (x, y, b), the action, (x, y, b) after it, whether r_N was above 0, and a_M.

    ``paid`` is UNTOLD in what was seen while another design was built.
    """

    x: int
    y: int
    blocks: int
    action: int
    next_x: int
    next_y: int
    next_blocks: int
    paid: int
    material: int


class Experience:
    """The last episodes of one run, the one that runs included.

    What an action led to is in ``steps``; what an episode of a material brought is in ``extras``.
    """

    def __init__(self) -> None:
        self.episodes = 0
        self._steps: list[RealStep] = []
        self._first_of_episode: list[int] = []
        self._extras: list[tuple[int, float, int]] = []

    @property
    def steps(self) -> Int64s:
        """The transitions (steps, 9), oldest first, the fields of RealStep."""
        return np.array(self._steps, dtype=np.int64).reshape(len(self._steps), len(RealStep._fields))

    @property
    def first_of_episode(self) -> Int64s:
        """Where in ``steps`` each remembered episode begins, (episodes,)."""
        return np.array(self._first_of_episode, dtype=np.int64)

    @property
    def length(self) -> tuple[int, int]:
        """How many episodes have begun, and how many steps are remembered: both change with what is in ``steps``."""
        return self.episodes, len(self._steps)

    @property
    def is_stuck(self) -> bool:
        """Whether whole episodes are remembered, and no block was used in any."""
        return bool(self._extras) and all(step.blocks == step.next_blocks for step in self._steps)

    @property
    def extras(self) -> Float64s:
        """For each finished episode its material, what it scored beyond the sum of r_N, and that sum, (episodes, 3)."""
        return np.array(self._extras, dtype=np.float64).reshape(len(self._extras), 3)

    def begin(self) -> None:
        """Begin an episode; the oldest is forgotten where there are too many."""
        self.episodes += 1
        self._first_of_episode.append(len(self._steps))
        if len(self._first_of_episode) > RECENT:
            dropped = self._first_of_episode[1]
            self._steps = self._steps[dropped:]
            self._first_of_episode = [first - dropped for first in self._first_of_episode[1:]]
            self._extras = self._extras[-RECENT:]

    def tried_here(self) -> list[int]:
        """Return the actions that were done in this episode in the cell where it has come to.

        It is empty before the episode's first step.
        """
        episode = self._steps[self._first_of_episode[-1] :] if self._first_of_episode else []
        return [step.action for step in episode if (step.x, step.y) == (episode[-1].next_x, episode[-1].next_y)]

    def add(self, step: RealStep) -> None:
        """Add what the last action did."""
        self._steps.append(step)

    def end(self, material: int, score: float) -> None:
        """End the episode, with its material and its score r_M."""
        earned = sum(step.paid for step in self._steps[self._first_of_episode[-1] :])
        self._extras.append((material, score - earned, earned))

    def begin_from(self, earlier: Mapping[str, NDArray[Any]], *, pays: bool, materials: bool) -> None:
        """Take over what another run's state holds; KeyError or ValueError if its shape differs.

        Its episodes aren't counted as this run's own. Without ``pays`` it isn't known what was paid, without
        ``materials`` not what each material brought.
        """
        self.load(earlier)
        self.episodes = 0
        if not pays:
            self._steps = [step._replace(paid=UNTOLD) for step in self._steps]
        if not materials:
            self._extras = []

    def state(self) -> Arrays:
        """Return everything, by name."""
        return {
            "steps": self.steps,
            "first_of_episode": self.first_of_episode,
            "extras": self.extras,
            "episodes": np.array(self.episodes),
        }

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        self.episodes = int(state["episodes"].item())  # a checkpoint gives it a dimension
        self._steps = [RealStep(*row) for row in state["steps"].tolist()]
        self._first_of_episode = state["first_of_episode"].tolist()
        self._extras = [(int(material), extra, int(earned)) for material, extra, earned in state["extras"].tolist()]
