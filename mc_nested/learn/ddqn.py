"""Double deep Q-learning (paper, section 2.4) for many independent networks, compiled.

A row is one learner: an online and a target network, its optimiser's moments and its count of updates. Rows never
meet: an update takes one row after the other, whose parameters and batch stay in the processor's nearest cache all the
while, and what comes out of it is the same to the bit whatever other rows there are.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from mc_nested.learn.adam import adam_step
from mc_nested.learn.imitation import rival
from mc_nested.learn.networks import Floats, Sizes, backward, forward, hidden_for, parameter_count
from mc_nested.learn.states import StateSpace
from mc_nested.learn.target_values import TargetValues

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class UpdateRule:
    """What an update does (README: the task): batch size, Adam's rate, the target's period and Huber's δ.

    ``margin`` is that of imitated actions (imitation.py).
    """

    batch: int
    learning_rate: float
    target_period: int
    huber_delta: float
    margin: float = 0.0


@dataclass(frozen=True)
class Batch:
    """Transitions for k rows: states (2, k, batch), actions, rewards and discounts (k, batch).

    ``states`` holds the number of every s, and of every s'; ``discounts`` is what the value of s' counts: γ, or 0 where
    the episode terminated. ``imitated`` (k, batch) says which actions are to be the greedy ones; ``weights`` (k, batch)
    what each error counts.
    """

    states: NDArray[np.integer[Any]]
    actions: NDArray[np.integer[Any]]
    rewards: Floats
    discounts: Floats
    imitated: Bools
    weights: Floats


class DDQN:
    """Rows of Q-networks with their targets and optimisers.

    Args:
        space: the states that they value and the actions that they choose among.
        sizes: widths of every network.
        rule: what an update does.
        online: initial parameters, (rows, parameters).
    """

    def __init__(self, space: StateSpace, sizes: Sizes, rule: UpdateRule, online: Floats) -> None:
        self.space = space
        self.sizes = sizes
        self.rule = rule
        self.online = online
        self.target = online.copy()
        self.updates: Ints = np.zeros(len(online), dtype=np.int64)
        self._first_moment, self._second_moment = np.zeros_like(online), np.zeros_like(online)
        self._target_values = TargetValues(space, sizes, self.target)
        self._last_values = np.full((len(online), rule.batch), np.nan, np.float32)
        self._last_errors = np.full((len(online), rule.batch), np.nan, np.float32)
        self._every_row = np.arange(len(online))
        self._widths = np.array(sizes, dtype=np.int64)
        self._acting = _Workspace.new(sizes, 1)
        self._learning = _Workspace.new(sizes, rule.batch)

    def take_over(self, online: Floats) -> None:
        """Go on from other networks (rows, parameters), the targets too; ValueError where their shape differs."""
        if online.shape != self.online.shape:
            raise ValueError(f"networks of {online.shape}, not {self.online.shape}")
        self.online[:] = self.target[:] = online
        self._target_values.renew(self._every_row, self.target)

    def q_values(self, states: Ints, rows: Ints | None = None) -> Floats:
        """The online networks' values (k, actions) of one numbered state a row (k,); of all rows unless named."""
        named = self._every_row if rows is None else rows
        values = np.empty((len(named), self.space.actions), np.float32)
        work = self._acting
        firsts = self.space.first_of(named)
        _value(named, states + firsts, self.online, self._widths, self.space.table, work.inputs, work.now, values)
        return values

    def update(self, rows: Ints, batch: Batch) -> Floats:
        """One update of each of the named rows (k,), each on its own part of the batch; the TD errors, (k, batch).

        By the gradient of the mean Huber loss, and of the mean large-margin loss of what is imitated.
        """
        rule, work = self.rule, self._learning
        self.updates[rows] += 1
        values, errors = np.empty_like(batch.rewards), np.empty_like(batch.rewards)
        _update(
            rows,
            (self.online, self._first_moment, self._second_moment),
            (batch.states, batch.actions),
            (batch.rewards, batch.discounts, batch.weights, values, errors),
            batch.imitated,
            self.space.first_of(rows),
            self.updates,
            self._widths,
            self.space.table,
            self._target_values.values,
            work.inputs,
            work.next_inputs,
            work.now,
            work.following,
            work.scratch,
            work.slope,
            work.gradient,
            (rule.learning_rate, rule.huber_delta, rule.margin),
        )
        self._last_values[rows], self._last_errors[rows] = values, errors
        due = rows[self.updates[rows] % rule.target_period == 0]
        if len(due):
            self.target[due] = self.online[due]
            self._target_values.renew(due, self.target[due])
        return errors

    def last_loss(self) -> Floats:
        """The mean Huber loss of each row's last update, (rows,); nan before the first."""
        size, delta = np.abs(self._last_errors), np.float32(self.rule.huber_delta)
        losses = np.where(size <= delta, size**2 / 2, delta * (size - delta / 2))
        mean: Floats = losses.mean(axis=1)
        return mean

    def last_q(self) -> Floats:
        """The mean value, Q(s, a), of the transitions of each row's last update, (rows,); nan before the first."""
        mean: Floats = self._last_values.mean(axis=1)
        return mean

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything the next update depends on, by name."""
        return {
            "online": self.online,
            "target": self.target,
            "first_moment": self._first_moment,
            "second_moment": self._second_moment,
            "updates": self.updates,
        }

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        for name, own in self.state().items():
            own[:] = state[name]
        self._target_values.renew(self._every_row, self.target)


@dataclass(frozen=True)
class _Workspace:
    """The standing arrays of one network's passes over one batch."""

    inputs: Floats
    next_inputs: Floats
    now: tuple[Floats, ...]
    following: tuple[Floats, ...]
    scratch: tuple[Floats, ...]
    slope: Floats
    gradient: Floats

    @classmethod
    def new(cls, sizes: Sizes, batch: int) -> "_Workspace":
        return cls(
            inputs=np.empty((sizes[0] + 1, batch), np.float32),
            next_inputs=np.empty((sizes[0] + 1, batch), np.float32),
            now=hidden_for(sizes, batch),
            following=hidden_for(sizes, batch),
            scratch=hidden_for(sizes, batch),
            slope=np.empty((sizes[-1], batch), np.float32),
            gradient=np.empty(parameter_count(sizes), np.float32),
        )


@njit(cache=True, error_model="numpy")
def td_target(reward: float, discount: float, next_online: Floats, next_target: Floats) -> float:
    """Y = r + γ Q(s', argmax Q(s'; θ); θ⁻), the bootstrap dropped where the episode terminated (paper, equation 4).

    ``next_online`` and ``next_target`` are the two networks' values of s', (actions,).
    """
    target: float = reward + discount * next_target[np.argmax(next_online)]
    return target


@njit(cache=True, error_model="numpy")
def _look_up(states: Ints, table: Floats, inputs: Floats) -> None:
    for column in range(len(states)):
        for feature in range(inputs.shape[0]):
            inputs[feature, column] = table[states[column], feature]


@njit(cache=True, error_model="numpy")
def _value(
    rows: Ints,
    states: Ints,
    online: Floats,
    sizes: Ints,
    table: Floats,
    inputs: Floats,
    hidden: Sequence[Floats],
    values: Floats,
) -> None:
    for at in range(len(rows)):
        _look_up(states[at : at + 1], table, inputs)
        forward(online[rows[at]], sizes, inputs, hidden, values[at].reshape(-1, 1))


@njit(cache=True, error_model="numpy")
def _update(
    rows: Ints,
    learners: tuple[Floats, Floats, Floats],
    whole: tuple[NDArray[np.integer[Any]], NDArray[np.integer[Any]]],
    real: tuple[Floats, Floats, Floats, Floats, Floats],
    imitated: Bools,
    firsts: Ints,
    updates: Ints,
    sizes: Ints,
    table: Floats,
    target_values: Floats,
    inputs: Floats,
    next_inputs: Floats,
    now: Sequence[Floats],
    following: Sequence[Floats],
    scratch: Sequence[Floats],
    slope: Floats,
    gradient: Floats,
    rule: tuple[float, float, float],
) -> None:
    """``update``, row by row; what is in the tuples is named as it is unpacked."""
    online, first_moment, second_moment = learners
    states, actions = whole
    rewards, discounts, weights, values, errors = real
    rate, delta, margin = rule
    batch = actions.shape[1]
    next_values, own_values = np.empty_like(slope), np.empty_like(slope)
    for at in range(len(rows)):
        row = rows[at]
        _look_up(states[0, at] + firsts[at], table, inputs)
        _look_up(states[1, at] + firsts[at], table, next_inputs)
        forward(online[row], sizes, next_inputs, following, next_values)
        forward(online[row], sizes, inputs, now, own_values)
        slope[:] = np.float32(0)
        for column in range(batch):
            action = actions[at, column]
            next_target = target_values[row, states[1, at, column]]
            target = td_target(rewards[at, column], discounts[at, column], next_values[:, column], next_target)
            values[at, column] = own_values[action, column]
            error = own_values[action, column] - target
            errors[at, column] = error
            slope[action, column] = min(max(error, -delta), delta) * weights[at, column] / batch
            if imitated[at, column]:
                other = rival(own_values[:, column], action, margin)
                if other != action:
                    slope[other, column] += np.float32(1 / batch)
                    slope[action, column] -= np.float32(1 / batch)
        backward(online[row], sizes, inputs, now, slope, gradient, scratch)
        adam_step(online[row], first_moment[row], second_moment[row], gradient, updates[row], rate)
