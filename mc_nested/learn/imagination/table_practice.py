"""Practice of the tables before that of the networks: begun anew, for longer, until a way found is good enough."""

import numpy as np
from numpy.random import Generator

from mc_nested.arrays import Float64s
from mc_nested.learn.imagination.arena_step import ImaginedArena, ImaginedTask
from mc_nested.learn.imagination.table_learner import QTables, TableProgress, begin_tables, learn_table, prefer_best

FIRST_STEPS = 250_000
"""Steps after which the tables begin anew for the first time; each time after that it is twice as many.

Most designs take less. Where the first ways found lead nowhere, other ways are found sooner than better ones.
"""

NEARLY_1 = 1 - 1e-6
"""The same blocks in another order may add up to this share of the score."""


class TablePractice:
    """One practice of the tables.

    Args:
        tables: they are begun anew by ``begin``.
        arena, task: what is practised.
        gamma: discounts the values by (x, y, b).
        most_steps: imagined steps after which it ends; at 0 there is none.
        random: the tables' first values come from here.
    """

    def __init__(
        self,
        tables: QTables,
        arena: ImaginedArena,
        task: ImaginedTask,
        gamma: float,
        most_steps: int,
        random: Generator,
    ) -> None:
        self._tables, self._arena, self._task, self._gamma = tables, arena, task, gamma
        self._most_steps, self._random = most_steps, random
        self._progress = TableProgress(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_))
        self._anew_at, self._anew_after = FIRST_STEPS, FIRST_STEPS

    @property
    def steps(self) -> int:
        """Imagined steps so far that were learnt from."""
        return int(self._progress.steps[0])

    @property
    def is_over(self) -> bool:
        """Whether a way that is good enough was found, or the steps are used up."""
        return bool(self._progress.reached[0]) or self.steps >= self._most_steps

    @property
    def aim(self) -> float:
        """What the networks can learn of it: the task's aim, or less if the best way known earns less."""
        return min(self._task.aim, NEARLY_1 * float(self._progress.score[0])) if self._most_steps else self._task.aim

    def begin(self) -> None:
        """Forget what was practised before."""
        if self._most_steps:
            begin_tables(self._tables, self._random)

    def learn(self, uniforms: Float64s) -> None:
        """Use up these numbers in [0, 1) for learning."""
        learn_table(uniforms, self._arena, self._task, self._gamma, self._tables, self._progress)
        if not self.is_over and self.steps >= self._anew_at:
            self._anew_after *= 2
            self._anew_at += self._anew_after
            begin_tables(self._tables, self._random)

    def end(self) -> None:
        """Make the values by (x, y, b) follow the best way known."""
        if self._most_steps:
            prefer_best(self._tables)
