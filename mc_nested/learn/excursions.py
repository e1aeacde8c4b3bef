"""Directed exploration: walk the own best episode again, leave it somewhere, and come back to it.

Nothing here but an agent's own past, gone through again by ``step``: what each of its actions came to at each place,
and what it did in its best episode so far. An excursion follows that episode up to some step, then wanders: at random,
but not into what wasted a block at that place before. Where it comes upon a later place of that episode, it may go on
as it did then; a block that had been missed is then one more.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.rules import SIZE
from mc_nested.learn.checkpoint import Arrays
from mc_nested.learn.preset import ExcursionRule

PLAN_NUMBERS, STEP_NUMBERS = 3, 3
"""Random numbers in [0, 1) that planning an excursion takes, and each of its steps."""

UNKNOWN, WASTED, ON_DESIGN, NO_BLOCK = 0, 1, 2, 3
"""What an action came to when it was last done at a place."""


class Step(NamedTuple):
    """One step as the low agent saw it: its place, its states as numbers, and whether a block was used up."""

    x: int
    y: int
    state: int
    action: int
    reward: float
    next_state: int
    terminated: bool
    used_block: bool


class Excursions:
    """The exploration of one run.

    Args:
        rule: how often and how far an excursion leaves the best episode.
        actions: how many actions the agent has.
    """

    def __init__(self, rule: ExcursionRule, actions: int) -> None:
        self.best: list[Step] = []
        self.best_row = 0
        self._rule = rule
        self._came_to = np.zeros((SIZE, SIZE, actions), dtype=np.int8)
        self._walk: list[Step] = []
        self._clean = True
        self._leave_at = self._wander_until = 0
        self._following: int | None = None

    def begin(self, numbers: NDArray[np.float64]) -> None:
        """Plan an excursion, by numbers (3,)."""
        at_its_end, where, how_far = numbers
        length = len(self.best)
        self._leave_at = length if at_its_end < self._rule.at_end else int(where * (length + 1))
        self._wander_until = self._leave_at + 1 + int(how_far * self._rule.wander)
        self._following = 0 if self._leave_at else None
        self._walk, self._clean = [], True

    def next_action(self, x: int, y: int, numbers: NDArray[np.float64]) -> int:
        """What to do next at x and y, by numbers (3,)."""
        rejoins, repeats, which = numbers
        came_to = self._came_to[x, y]
        done = len(self._walk)
        if self._following is None and self._clean and self._leave_at < done <= self._wander_until:
            here = [i for i in range(self._leave_at, len(self.best)) if (self.best[i].x, self.best[i].y) == (x, y)]
            if here and rejoins < self._rule.rejoin:
                self._following = here[int(which * len(here))]
        if self._following is not None:
            action = self.best[self._following].action
            self._following += 1
            if self._following == (self._leave_at if done < self._leave_at else len(self.best)):
                self._following = None
            if came_to[action] != WASTED or done < self._leave_at:
                return action
            self._following = None
        on_design = np.flatnonzero(came_to == ON_DESIGN)
        if len(on_design) and repeats < self._rule.repeat:
            return int(on_design[int(which * len(on_design))])
        not_wasted = np.flatnonzero(came_to != WASTED)
        return int(not_wasted[int(which * len(not_wasted))]) if len(not_wasted) else int(which * len(came_to))

    def saw(self, step: Step) -> None:
        """Take note of what the last action came to."""
        known = self._came_to[step.x, step.y, step.action]
        if step.used_block:
            self._came_to[step.x, step.y, step.action] = ON_DESIGN if step.reward > 0 else WASTED
        elif known == UNKNOWN:  # else the front was taken already, which tells nothing new
            self._came_to[step.x, step.y, step.action] = NO_BLOCK
        if step.used_block and step.reward <= 0:
            self._clean, self._following = False, None
        if self._clean:
            self._walk.append(step)

    def end(self, row: int) -> bool:
        """The episode, an excursion or a greedy one, is over; whether it is the best so far, or as good.

        ``row`` is the learner's that walked.

        What counts are the blocks on the design before the first that was wasted, then the fewest steps.
        """
        built = [i for i, step in enumerate(self._walk) if step.used_block]
        walk = without_loops(self._walk[: built[-1] + 1]) if built else []
        if (blocks_in(walk), -len(walk)) < (blocks_in(self.best), -len(self.best)):
            return False
        self.best, self.best_row = walk, row
        return True

    def state(self) -> Arrays:
        """Everything later steps depend on, by name."""
        following = -1 if self._following is None else self._following
        plan = [self.best_row, self._clean, self._leave_at, self._wander_until, following]
        return {
            "came_to": self._came_to,
            "plan": np.array(plan, dtype=np.int64),
            "best": _table(self.best),
            "walk": _table(self._walk),
        }

    def load(self, state: Arrays) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        self._came_to[:] = state["came_to"]
        self.best_row, clean, self._leave_at, self._wander_until, following = (int(value) for value in state["plan"])
        self._clean, self._following = bool(clean), None if following < 0 else following
        self.best, self._walk = _steps(state["best"]), _steps(state["walk"])


def blocks_in(walk: list[Step]) -> int:
    """Blocks that the walk used."""
    return sum(step.used_block for step in walk)


def without_loops(walk: list[Step]) -> list[Step]:
    """The walk without what lies between two visits of one state: no block was placed there, so nothing changed."""
    kept: list[Step] = []
    at: dict[int, int] = {}
    for step in walk:
        if step.state in at:
            for undone in kept[at[step.state] :]:
                del at[undone.state]
            del kept[len(at) :]
        at[step.state] = len(kept)
        kept.append(step)
    return kept


def _table(steps: list[Step]) -> NDArray[np.float64]:
    return np.array(steps, dtype=np.float64).reshape(len(steps), len(Step._fields))


def _steps(table: NDArray[Any]) -> list[Step]:
    return [
        Step(int(x), int(y), int(state), int(action), float(reward), int(following), bool(terminated), bool(used))
        for x, y, state, action, reward, following, terminated, used in table.tolist()
    ]
