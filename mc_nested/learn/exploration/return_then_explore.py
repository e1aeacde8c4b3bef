"""Directed exploration: repeat the run's own best episode up to some step, explore from there, and rejoin its path.

After Go-Explore (Ecoffet et al., "First return, then explore", Nature 590, 2021): first return to a known state, then
explore. It differs in what it keeps and how it returns. There is no archive of cells, only the best episode of the run,
and a record of what each action did in each cell of the arena, for each part of the design: what is on the design
depends on the part that is built. It returns by repeating that episode's actions from the start, never by restoring a
simulator's state. Exploration is random, but avoids what wasted a block in that cell before. Where it meets a later
cell of the best episode, it may follow that episode again; a block that had been skipped is then one more.

The best episode is followed only while x, y and b are those that it leads to. Where an action slipped, they aren't:
what comes next in the best episode was right in another cell, and the excursion explores from there instead.
"""

from typing import NamedTuple

import numpy as np

from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.arrays import Arrays, Float64s
from mc_nested.learn.episode_log import rows_of_table, table_of_rows
from mc_nested.learn.preset import ExcursionRule

PLAN_NUMBERS, STEP_NUMBERS = 3, 3
"""Random numbers in [0, 1) needed to plan an excursion, and for each of its steps."""

UNKNOWN, WASTED, ON_DESIGN, NO_BLOCK = 0, 1, 2, 3
"""What an action did when it was last tried in a cell."""


class EpisodeStep(NamedTuple):
    """One step as the low-level agent saw it: cell, states as indices, and whether a block was used up.

    ``part`` is the index of the part that was built, ``row`` the learner's row that acted.
    """

    x: int
    y: int
    state: int
    action: int
    reward: float
    next_state: int
    terminated: bool
    used_block: bool
    part: int = 0
    row: int = 0


class ReturnThenExplore:
    """The exploration of one run.

    Args:
        rule: how often and how far an excursion leaves the best episode.
        actions: how many actions the agent has.
        size: cells along each side of the arena.
        parts: how many parts the design is built in.
    """

    def __init__(self, rule: ExcursionRule, actions: int, size: int = DEFAULT_SIZE, parts: int = 1) -> None:
        self.best: list[EpisodeStep] = []
        self._rule = rule
        self._effects = np.zeros((parts, size, size, actions), dtype=np.int8)
        self._walk: list[EpisodeStep] = []
        self._clean = True
        self._leave_at = self._wander_until = 0
        self._following: int | None = None

    def begin(self, numbers: Float64s) -> None:
        """Plan an excursion from 3 random numbers."""
        at_its_end, where, how_far = numbers
        length = len(self.best)
        self._leave_at = length if at_its_end < self._rule.at_end else int(where * (length + 1))
        self._wander_until = self._leave_at + 1 + int(how_far * self._rule.wander)
        self._following = 0 if self._leave_at else None
        self._walk, self._clean = [], True

    def next_action(self, x: int, y: int, numbers: Float64s, part: int = 0) -> int:
        """Return what to do next at x and y, while that part is built, from 3 random numbers."""
        rejoins, repeats, which = numbers
        effects = self._effects[part, x, y]
        done = len(self._walk)
        if self._following is not None and not self._is_where_it_leads(self._following, x, y):
            self._stop_following(done)
        if self._may_rejoin(done):
            later = enumerate(self.best[self._leave_at :], self._leave_at)
            here = [i for i, step in later if (step.x, step.y, step.part) == (x, y, part)]
            if here and rejoins < self._rule.rejoin:
                self._following = here[int(which * len(here))]
        if self._following is not None:
            action = self._follow(self._following, done)
            if effects[action] != WASTED or done < self._leave_at:
                return action
            self._following = None
        on_design = np.flatnonzero(effects == ON_DESIGN)
        if len(on_design) and repeats < self._rule.repeat:
            return int(on_design[int(which * len(on_design))])
        not_wasted = np.flatnonzero(effects != WASTED)
        return int(not_wasted[int(which * len(not_wasted))]) if len(not_wasted) else int(which * len(effects))

    def observe(self, step: EpisodeStep) -> None:
        """Record what the last action did."""
        effects = self._effects[step.part, step.x, step.y]
        if step.used_block:
            effects[step.action] = ON_DESIGN if step.reward > 0 else WASTED
        elif effects[step.action] == UNKNOWN:  # otherwise the cell in front was taken already, which says nothing new
            effects[step.action] = NO_BLOCK
        if step.used_block and step.reward <= 0:
            self._clean, self._following = False, None
        if self._clean:
            self._walk.append(step)

    def end(self) -> bool:
        """End the episode, an excursion or a greedy one; return whether it is the best so far, or as good.

        More blocks on the design before the first wasted block are better, then fewer steps.
        """
        built = [i for i, step in enumerate(self._walk) if step.used_block]
        walk = without_loops(self._walk[: built[-1] + 1]) if built else []
        if (blocks_in(walk), -len(walk)) < (blocks_in(self.best), -len(self.best)):
            return False
        self.best = walk
        return True

    def state(self) -> Arrays:
        """Return everything that later steps depend on, by name."""
        following = -1 if self._following is None else self._following
        plan = [self._clean, self._leave_at, self._wander_until, following]
        return {
            "effects": self._effects,
            "plan": np.array(plan, dtype=np.int64),
            "best": table_of_rows(self.best, EpisodeStep),
            "walk": table_of_rows(self._walk, EpisodeStep),
        }

    def load(self, state: Arrays) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        self._effects[:] = state["effects"]
        clean, self._leave_at, self._wander_until, following = (int(value) for value in state["plan"])
        self._clean, self._following = bool(clean), None if following < 0 else following
        self.best, self._walk = (rows_of_table(state[name], EpisodeStep) for name in ("best", "walk"))

    def _may_rejoin(self, done: int) -> bool:
        return self._following is None and self._clean and self._leave_at < done <= self._wander_until

    def _is_where_it_leads(self, index: int, x: int, y: int) -> bool:
        """Return whether the last step, if it was the best episode's step before ``index``, did the same as there.

        The start is the same, so x, y and b agree with it as long as every step does. Having rejoined, b may differ by
        the blocks that one has more than the other.
        """
        if (x, y) != (self.best[index].x, self.best[index].y):
            return False
        return not self._walk or not index or self._walk[-1].used_block == self.best[index - 1].used_block

    def _stop_following(self, done: int) -> None:
        """Explore from here, as far as planned from where the best episode was to be left."""
        if done < self._leave_at:
            self._wander_until += done - self._leave_at
            self._leave_at = done
        self._following = None

    def _follow(self, index: int, done: int) -> int:
        """Return the best episode's action at that index; the next step follows it too, up to where it is left."""
        following = index + 1
        stop = self._leave_at if done < self._leave_at else len(self.best)
        self._following = None if following == stop else following
        return self.best[index].action


def blocks_in(walk: list[EpisodeStep]) -> int:
    """Return blocks that the walk used."""
    return sum(step.used_block for step in walk)


def without_loops(walk: list[EpisodeStep]) -> list[EpisodeStep]:
    """Return the walk without its loops. Between two visits of one state no block was placed, so nothing changed."""
    kept: list[EpisodeStep] = []
    at: dict[int, int] = {}
    for step in walk:
        if step.state in at:
            for undone in kept[at[step.state] :]:
                del at[undone.state]
            del kept[len(at) :]
        at[step.state] = len(kept)
        kept.append(step)
    return kept
