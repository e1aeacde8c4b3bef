"""Directed exploration: repeat the run's own best episode up to some step, explore from there, and rejoin its path.

After Go-Explore (Ecoffet et al., "First return, then explore", Nature 590, 2021): first return to a known state, then
explore. It differs in what it keeps and how it returns. There is no archive of cells, only the best episode of the run,
and a record of what each action did in each cell of the arena, for each part of the design: what is on the design
depends on the part that is built. It returns by repeating that episode's actions from the start, never by restoring a
simulator's state. Exploration is random, but avoids what wasted a block in that cell before. Where it meets a later
cell of the best episode, it may follow that episode again; a block that had been skipped is then one more.

The best episode is followed only while x, y and b are those that it leads to. Where an action slipped, they aren't:
what comes next in the best episode was right in another cell, and the excursion explores from there instead.

The practice of a preset with [excursions]: every run returns along its best episode, then explores.

The best episodes are handed to the low-level learners to imitate.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from mc_nested.arena.env import BLOCKS_LEFT, X, Y
from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arrays import Arrays, Float64s, Int64s, named_parts, part_of
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.engine import lesson
from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.self_imitation import BestEpisodes
from mc_nested.learn.dqn.states import numbered
from mc_nested.learn.episode_log import rows_of_table, table_of_rows
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import ExcursionRule, Preset

PLAN_NUMBERS, STEP_NUMBERS = 3, 3
"""Random numbers in [0, 1) needed to plan an excursion, and for each of its steps."""

MOST_LESSONS, LOOK_EVERY = 5000, 50
"""Updates by which networks learn the best episode, at most; and from one look at what they do to the next."""

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
        if self._following is None and self._clean and self._leave_at < done <= self._wander_until:
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


class Excursions(Practice):
    """The paper's practice, and excursions in the place of ε, in all of an agent's runs.

    A greedy episode is learned from in another way: what its actions did is remembered, and if it is the best episode
    so far, excursions follow it and updates imitate it.

    Args:
        agent: the agent whose low-level agents act.
        preset: the hyper-parameters.
        rule: how often and how far excursions leave the best episode.
        scenarios: each run's scenario.
    """

    numbers = PLAN_NUMBERS + STEP_NUMBERS

    def __init__(self, agent: Agent, preset: Preset, rule: ExcursionRule, scenarios: Sequence[Scenario]) -> None:
        super().__init__(agent, preset)
        self._low_level, self._space = agent.low_level, numbered(agent.low_level.states)
        self._explorers = [
            ReturnThenExplore(rule, self._space.actions, agent.size, len(scenario.in_order)) for scenario in scenarios
        ]
        self._part_at = [[scenario.part_at(left) for left in range(scenario.blocks + 1)] for scenario in scenarios]

    def begin(self, runs: Int64s, numbers: Float64s) -> None:
        """Plan an excursion in each of the named runs; a greedy episode doesn't follow it, and is only observed."""
        for run in runs:
            self._explorers[run].begin(numbers[run, :PLAN_NUMBERS])

    def act(self, runs: Int64s, observations: NDArray[Any], actions: Int64s, numbers: Float64s) -> Int64s:
        """Return all runs' actions; those of the named runs are the next ones of their excursions."""
        for run in runs.tolist():
            x, y, left = observations[run, [X, Y, BLOCKS_LEFT]].tolist()
            part = self._part_at[run][left]
            actions[run] = self._explorers[run].next_action(x, y, numbers[run, PLAN_NUMBERS:], part)
        return actions

    def observe(self, step: Step, next_states: NDArray[Any]) -> None:
        """Record what the actions of all running runs did, in greedy episodes, too."""
        runs = np.flatnonzero(step.running)
        before, states, next_states = step.observations[runs], step.states[runs], next_states[runs]
        actions, rewards, terminated = step.actions[runs], step.rewards[runs], step.terminated[runs]
        rows = self._agent.low_level_rows(runs, step.materials)
        indices, next_indices = self._space.encoded(states), self._space.encoded(next_states)
        used = before[:, BLOCKS_LEFT] > next_states[:, BLOCKS_LEFT]
        parts = np.array([self._part_at[run][left] for run, left in zip(runs, before[:, BLOCKS_LEFT], strict=True)])
        columns = (before[:, X], before[:, Y], indices, actions, rewards, next_indices, terminated, used, parts, rows)
        for run, *values in zip(runs.tolist(), *(column.tolist() for column in columns), strict=True):
            self._explorers[run].observe(EpisodeStep(*values))

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:  # noqa: ARG002 - the best is known by its steps
        for run in runs.tolist():
            last = {step.row for step in self._explorers[run].best}
            if self._explorers[run].end() and self._low_level.best:
                for row in last:
                    self._low_level.best.forget(row)
                self._imitate(self._low_level.best, run)

    def teach_best(self, run: int, material: int, random: Generator) -> bool:
        """Let the networks of a run without parts do what its best episode did, with that material in hand.

        Return whether they do it now and didn't before.
        """
        walk, every_material = self._explorers[run].best, int(self._space.strides[2])
        rows = self._agent.low_level_rows(np.array([run]), np.full(run + 1, material))
        engine, batch = self._low_level.engine, self._low_level.engine.rule.batch
        states = np.array([step.state - step.state % every_material for step in walk], dtype=np.int64)
        states += material * (every_material > 1)
        actions = np.array([step.action for step in walk], dtype=np.int64)
        for update in range(MOST_LESSONS if walk else 0):
            values = engine.q_values(states, rows.repeat(len(walk))) if update % LOOK_EVERY == 0 else None
            if values is not None and (values.argmax(axis=1) == actions).all():
                return update > 0
            at, tried = np.divmod(random.integers(0, len(walk) * self._space.actions, batch), self._space.actions)
            engine.update(rows, lesson(states[at], tried, (tried == actions[at]).astype(np.float32)))
        return False

    def state(self) -> Arrays:
        return named_parts({str(run): explorer.state() for run, explorer in enumerate(self._explorers)})

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        for run, explorer in enumerate(self._explorers):
            explorer.load(part_of(state, str(run)))
            if self._low_level.best:
                self._imitate(self._low_level.best, run)

    def _imitate(self, best: BestEpisodes, run: int) -> None:
        """Let each row that acted in the run's best episode imitate its own steps of it."""
        walk = self._explorers[run].best
        for row in {step.row for step in walk}:
            best.keep(row, self._transitions([step for step in walk if step.row == row]))

    def _transitions(self, walk: list[EpisodeStep]) -> Transitions:
        terminated = np.array([step.terminated for step in walk], dtype=np.bool_)
        return Transitions(
            np.array([[step.state, step.next_state] for step in walk], dtype=np.int64).T,
            np.array([step.action for step in walk], dtype=np.int64),
            np.array([step.reward for step in walk]),
            self._low_level.discounts(terminated),
        )
