"""How the agents with objectives learn: both in many arenas side by side, each by double DQN from its own replay.

The nested agent gets an objective at random, in an arena in which something stands. Its r_N is 1 for a block on it; its
episode ends with a placed block, or after PATIENCE steps. By hindsight (Andrychowicz et al., 2017), the cell where a
block landed instead was the objective, too.

The main agent builds designs drawn at random, through the nested agent, which has learnt. It acts again when that is
done. Its r_M: for each objective a share of a block that is on the design, less what the steps cost, less 1 for a wrong
block or for an objective that wasn't reached, and less 1 where cells are lost.
"""

from collections import deque
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import SMALLEST_SIZE, Action
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.states import WANTED
from mc_nested.learn.learner import Learner
from mc_nested.learn.objectives.arenas import (
    NOWHERE,
    framed_cells,
    order_planes,
    outside,
    plane_of_each,
    reach_planes,
    reached_from,
    side_for,
    step,
)
from mc_nested.learn.objectives.decide import PATIENCE
from mc_nested.learn.objectives.drawn import drawn_design, drawn_obstacles, drawn_size
from mc_nested.learn.objectives.networks import OrderNetwork, ReachNetwork
from mc_nested.learn.preset import Exploration, ObjectivesRule, Update

NEAR_CELLS = 2
"""An objective so near is drawn more often, and one beside which something stands."""

BLOCK, MISTAKE = 0.2, 1.0
"""What a block on the design is worth to the main agent, and what a mistake costs."""

LOWEST = -2 * MISTAKE
"""The least reward of an objective: a long way round would be one error that outweighs all others."""

LATELY, GREEDY_SHARE = 1000, 8
"""Episodes that a line looks back to, and the share of the arenas, one in so many, that it looks at."""

THE_ROW = np.zeros(1, np.int64)

RATES = ((0.6, 1.0), (0.85, 0.3), (1.0, 0.1))
"""The learning rate's share until each share of a training has passed."""


def rate_after(share: float) -> float:
    """Return the share of the learning rate that is left after that share of a training."""
    return next((rate for until, rate in RATES if share < until), RATES[-1][1])


class DesignDone(NamedTuple):
    """An episode of the main agent that has ended: the share of its design that stands, and its steps."""

    share: float
    steps: int


class _Lessons:
    """Arenas side by side, (E, side, side), and a learner of one row.

    Args:
        learner: what learns.
        rule: in what.
        update: how.
        arenas: how many.
    """

    def __init__(self, learner: Learner, rule: ObjectivesRule, update: Update, arenas: int) -> None:
        self._learner, self._rule = learner, rule
        self._gamma, self._rate = update.gamma, update.learning_rate
        self._arenas, self._largest = arenas, rule.largest
        self.side = side_for(rule.largest)
        self._occupied = np.ones((arenas, self.side, self.side), np.bool_)
        self._wanted = np.zeros_like(self._occupied)
        self._agents = np.ones((arenas, 2), np.int64)
        self._steps = np.zeros(arenas, np.int64)
        self._is_fresh = np.ones(arenas, np.bool_)

    @property
    def updates(self) -> int:
        """Updates so far."""
        return int(self._learner.engine.updates[0])

    def state(self) -> Arrays:
        """Return where every arena is in its episode."""
        return {name: getattr(self, f"_{name}").copy() for name in self._STATE}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        for name in self._STATE:
            getattr(self, f"_{name}")[:] = state[name]

    _STATE: tuple[str, ...] = ("occupied", "wanted", "agents", "steps", "is_fresh")

    def _store(self, before: Bools, actions: Int64s, rewards: Float64s, after: Bools, discounts: Float64s) -> None:
        both = self._learner.states.encoded(np.stack((before, after)))
        self._learner.replay.add_several(0, Transitions(both, actions, rewards, discounts))

    def _update(self, random: np.random.Generator, share: float) -> None:
        engine = self._learner.engine
        engine.rule = engine.rule._replace(learning_rate=self._rate * rate_after(share))
        for _ in range(self._rule.updates_a_round):
            self._learner.learn(THE_ROW, random.random((1, engine.rule.batch)))


class NestedLessons(_Lessons):
    """The nested agent's lessons. ε differs from arena to arena: from the exploration's ``floor`` to its ``start``."""

    def __init__(self, learner: Learner, rule: ObjectivesRule, update: Update, exploration: Exploration) -> None:
        super().__init__(learner, rule, update, rule.nested_arenas)
        self._longest = PATIENCE * self.side
        ladder = np.linspace(0, 1, rule.nested_arenas) ** 2
        self._epsilon = exploration.floor + (exploration.start - exploration.floor) * ladder
        self._path = np.zeros((rule.nested_arenas, self._longest, 2), np.int64)
        self._actions = np.zeros((rule.nested_arenas, self._longest), np.int64)
        self._reached: deque[bool] = deque(maxlen=LATELY)

    def in_words(self) -> str:
        """Return how well the nested agent does lately, in the arenas of the lowest ε."""
        share = np.mean(self._reached) if self._reached else 0.0
        return f"the nested agent reaches {share:.0%} of its objectives, after {self.updates:,} updates"

    _STATE = (*_Lessons._STATE, "path", "actions")

    def round(self, random: np.random.Generator) -> None:
        """Do a step in every arena, and updates."""
        for arena in self._is_fresh.nonzero()[0].tolist():
            self._begin(arena, random)
        every = np.arange(self._arenas)
        before = reach_planes(self._wanted, self._occupied, self._agents, self._rule.nested_sees)
        network = ReachNetwork(self._learner.engine.online[0])
        actions = network.values(network.reaching(before), self._agents).argmax(1)
        explores = random.random(self._arenas) < (self._epsilon if self.updates else 1.0)
        actions = np.where(explores, random.integers(0, len(Action), self._arenas), actions)
        self._path[every, self._steps], self._actions[every, self._steps] = self._agents, actions
        stood, landed = self._occupied.copy(), np.empty((self._arenas, 2), np.int64)
        step(self._occupied, self._agents, actions, every, landed)
        self._steps += 1
        has_landed = landed[:, 0] != NOWHERE
        hits = has_landed & self._wanted[every, landed[:, 0], landed[:, 1]]
        after = reach_planes(self._wanted, stood, self._agents, self._rule.nested_sees)
        self._store(before, actions, hits.astype(np.float64), after, np.where(has_landed, 0.0, self._gamma))
        if self._rule.hindsight:
            for arena in (has_landed & ~hits).nonzero()[0].tolist():
                self._relabel(arena, stood[arena], landed[arena])
        self._is_fresh = has_landed | (self._steps >= self._longest)
        greedy = self._is_fresh[: self._arenas // GREEDY_SHARE]
        self._reached.extend(hits[: len(greedy)][greedy].tolist())
        self._update(random, self.updates / self._rule.nested_updates)

    def _begin(self, arena: int, random: np.random.Generator) -> None:
        goals = np.empty((0, 2), np.int64)
        while not len(goals):
            size = drawn_size(random, SMALLEST_SIZE, self._largest)
            occupied = outside(size, self.side)
            occupied[1 : size + 1, 1 : size + 1] |= drawn_obstacles(random, size, self._rule.most_blocks)
            free = np.argwhere(~occupied)
            if len(free):
                agent = free[random.integers(len(free))]
                reached = reached_from(occupied, agent[0], agent[1], np.empty((self.side**2, 2), np.int64))
                goals = free[reached[free[:, 0], free[:, 1] - 1]]
        self._occupied[arena], self._agents[arena] = occupied, agent
        chance, (x, y) = random.random(), goals.T
        some = (
            np.abs(goals - agent).sum(1) <= NEAR_CELLS,
            occupied[x + 1, y] | occupied[x - 1, y] | occupied[x, y + 1],
            np.ones(len(goals), np.bool_),
        )[min(int(chance * 3), 2)]
        chosen = goals[some] if some.any() else goals
        self._wanted[arena] = plane_of_each(chosen[random.integers(len(chosen))][None], self.side)[0]
        self._steps[arena] = 0

    def _relabel(self, arena: int, stood: Bools, landed: Int64s) -> None:
        """Store the episode once more, as if its block's cell had been the objective."""
        steps = int(self._steps[arena])
        cells = np.concatenate((self._path[arena, :steps], self._agents[arena : arena + 1]))
        wanted = np.broadcast_to(plane_of_each(landed[None], self.side), (steps + 1, self.side, self.side))
        planes = reach_planes(wanted, np.broadcast_to(stood, wanted.shape), cells, self._rule.nested_sees)
        is_last = np.arange(steps) == steps - 1
        discounts = np.where(is_last, 0.0, self._gamma)
        self._store(planes[:-1], self._actions[arena, :steps], is_last.astype(np.float64), planes[1:], discounts)


class MainLessons(_Lessons):
    """The main agent's lessons. ``wanted`` are the cells that are still to be built."""

    def __init__(self, learner: Learner, rule: ObjectivesRule) -> None:
        super().__init__(learner, rule, rule.main_update, rule.main_arenas)
        self._blocks, self._built = (np.ones(rule.main_arenas, np.int64) for _ in range(2))
        self._floor = np.linspace(0, rule.highest_epsilon, rule.main_arenas)

    _STATE = (*_Lessons._STATE, "blocks", "built")

    def round(
        self, random: np.random.Generator, nested: ReachNetwork, epsilon: float, share: float
    ) -> list[DesignDone]:
        """Let the nested agent reach an objective in every arena, then do updates; return the episodes that ended."""
        for arena in self._is_fresh.nonzero()[0].tolist():
            self._begin(arena, random)
        every = np.arange(self._arenas)
        before, _ = order_planes(self._wanted, self._occupied, self._agents)
        self._wanted[:] = before[:, WANTED]
        values = OrderNetwork(self._learner.engine.online[0]).values(before).reshape(self._arenas, -1)
        explores = random.random(self._arenas) < np.maximum(epsilon, self._floor)
        by_chance = np.where(self._wanted.reshape(self._arenas, -1), random.random(values.shape), -1.0)
        chosen = np.where(explores[:, None], by_chance, values).argmax(1)
        landed, steps = self._reach(nested, np.stack(np.divmod(chosen, self.side), axis=1))
        self._steps += steps
        has_landed = landed[:, 0] != NOWHERE
        on_design = has_landed & self._wanted[every, landed[:, 0], landed[:, 1]]
        self._wanted[every[on_design], landed[on_design, 0], landed[on_design, 1]] = False
        self._built += on_design
        after, lost = order_planes(self._wanted, self._occupied, self._agents)
        self._wanted[:] = after[:, WANTED]
        rewards = np.where(on_design, BLOCK, -MISTAKE) - MISTAKE * (lost > 0) - self._rule.step_cost * steps
        self._is_fresh = ~has_landed | ~self._wanted.any((1, 2))
        discounts = np.where(self._is_fresh, 0.0, self._gamma)
        self._store(before, chosen, np.maximum(rewards, LOWEST), after, discounts)
        self._update(random, share)
        ended = self._is_fresh.nonzero()[0]
        return [DesignDone(self._built[arena] / self._blocks[arena], int(self._steps[arena])) for arena in ended]

    def _begin(self, arena: int, random: np.random.Generator) -> None:
        size = drawn_size(random, SMALLEST_SIZE, self._largest)
        design = drawn_design(random, size, self._rule.most_blocks)
        self._occupied[arena] = outside(size, self.side)
        self._wanted[arena] = framed_cells(design, self.side)
        if random.random() < self._rule.any_start:
            self._agents[arena] = random.integers(1, size + 1, 2)
        else:  # the middle of the far edge, where the shipped designs start, or of the near one
            self._agents[arena] = (size + 1) // 2, size if random.random() < self._rule.any_start else 1
        self._blocks[arena], self._built[arena], self._steps[arena] = len(design), 0, 0

    def _reach(self, nested: ReachNetwork, objectives: Int64s) -> tuple[Int64s, Int64s]:
        """Let the nested agent act in every arena until a block has landed: return where, (E, 2), and its steps, (E,).

        No action is tried twice in a cell; what isn't reached after PATIENCE steps is given up.
        """
        every = np.arange(self._arenas)
        landed, steps = np.full((self._arenas, 2), NOWHERE), np.zeros(self._arenas, np.int64)
        wanted = plane_of_each(objectives, self.side)
        planes = reach_planes(wanted, self._occupied, self._agents, self._rule.nested_sees)
        reaching = nested.reaching(planes)
        tried = np.zeros((self._arenas, self.side, self.side, len(Action)), np.bool_)
        rows = every
        for _ in range(PATIENCE * self.side):
            cells = self._agents[rows]
            values = nested.values(reaching.of(rows), cells)
            values[tried[rows, cells[:, 0], cells[:, 1]]] = -np.inf
            actions = values.argmax(1)
            tried[rows, cells[:, 0], cells[:, 1], actions] = True
            where = np.empty((len(rows), 2), np.int64)
            step(self._occupied, self._agents, actions, rows, where)
            landed[rows] = where
            steps[rows] += 1
            rows = rows[where[:, 0] == NOWHERE]
            if not len(rows):
                break
        return landed, steps
