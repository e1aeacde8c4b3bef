"""The first tries of a run: actions of which it isn't known yet where they lead, before the policy's.

They depend only on what the episode has shown so far, so a game can go on with them by itself (learn/games).
"""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np

from mc_nested.arrays import Bools, Int64s

FIRST_TRIES = 0.125
"""This share of the steps tries an action of which it isn't known where it leads."""

CLAIMED = 2
"""How many next tries are left to each other game: with four games, each begins with actions of its own."""


@dataclass(frozen=True)
class FirstTries:
    """What one run has tried of its actions, (actions,) each. Its arrays change with what is observed.

    ``explores``: paying cells are still to be found. ``falls_short``: its last practice did. ``is_stuck``: in whole
    episodes no block was used. ``untried`` actions have never moved, the moves of ``unclear`` ones may be slips,
    ``tries`` counts.
    """

    explores: bool
    falls_short: bool
    is_stuck: bool
    untried: Bools
    unclear: Bools
    tries: Int64s

    def act(self, action: int, tried_here: Collection[int]) -> int:
        """Return the action to do: the policy's, which is given, once it is known what all of them do.

        An action that has never moved is tried in other cells of an episode than where it was already: at an edge, it
        would be stopped for ever. So is one whose move may be a slip. Once all cells are known, it is tried where
        practice fell short of building them all. ``tried_here`` were done in this episode in the agent's cell.
        """
        if self.are_over:
            return action
        untried = self._open()
        if self.is_stuck:  # each cell is left by its actions in turn, which comes to every cell that can be reached
            here = list(tried_here)
            return min(range(len(self.tries)), key=lambda each: (here.count(each), self.tries[each]))
        untried[list(tried_here)] = False
        tries = np.where(untried, self.tries, np.iinfo(np.int64).max)
        return int(tries.argmin()) if tries.min() <= FIRST_TRIES * self.tries.sum() else action

    @property
    def are_over(self) -> bool:
        """Whether ``act`` does the policy's action from now on, until the next practice."""
        return not (self._open().any() and (self.explores or self.falls_short))

    def observe(self, action: int, moved: bool, tried_here: Collection[int]) -> None:
        """Count an action that was done, and whether it moved the agent; ``tried_here`` as for ``act``, before it."""
        if moved:
            self.untried[action] = False
        # A policy that goes round would make an action that stays look tried out.
        self.tries[action] += action not in tried_here

    def copied(self) -> "FirstTries":
        """Return a copy with arrays of its own."""
        return replace(self, untried=self.untried.copy(), unclear=self.unclear.copy(), tries=self.tries.copy())

    def beside(self, games: int) -> "FirstTries":
        """Return a copy that leaves the next tries to so many other games: it begins with the actions after those."""
        own = self.copied()
        for _ in range(games):
            tries = np.where(own._open(), own.tries, np.iinfo(np.int64).max)
            claimed = np.argsort(tries, kind="stable")[: min(CLAIMED, int(own._open().sum()))]
            own.tries[claimed] += 1
        return own

    def _open(self) -> Bools:
        """Return the actions of which it isn't known where they lead."""
        return self.untried | self.unclear
