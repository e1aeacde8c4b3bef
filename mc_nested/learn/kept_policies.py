"""The policies that the runs keep: what plays afterwards."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays


class Plays(Protocol):
    """An agent whose policies can be kept (agents.py, cooperation/team_agent.py)."""

    @property
    def runs(self) -> Sequence[int]:
        """The numbers of its runs."""

    def online(self) -> Arrays:
        """The online networks' parameters, by role."""

    def rows_of(self, run: int) -> dict[str, slice]:
        """A run's rows, by role."""


class KeptPolicies:
    """A copy of each run's online networks at one of its greedy evaluations, and the score there.

    ``online`` is by role; ``scores`` is (runs,), -inf before the first evaluation.
    """

    def __init__(self, agent: Plays) -> None:
        self._agent = agent
        self.scores = np.full(len(agent.runs), -np.inf)
        self.take_all()

    def take_all(self) -> None:
        """Keep the networks of every run as they are; no score is known of them."""
        self.online = {role: online.copy() for role, online in self._agent.online().items()}

    def take(self, run: int, score: float, online: Mapping[str, NDArray[Any]] | None = None) -> None:
        """Keep a run's networks, which have scored that: as they are, or as all runs' were, by role."""
        self.scores[run] = score
        played = self._agent.online() if online is None else online
        for role, rows in self._agent.rows_of(run).items():
            if role in self.online:
                self.online[role][rows] = played[role][rows]
