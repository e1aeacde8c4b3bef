"""Double deep Q-learning (paper, section 2.4) for many independent networks, compiled.

A row is one learner: an online and a target network, its optimiser's moments and its count of updates. Rows are
independent: an update handles one row after the other, so that its parameters and batch stay in the processor's nearest
cache, and the result is the same to the bit whatever other rows there are.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float32s, Int32s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.adam import adam_step
from mc_nested.learn.dqn.compiled_engine.networks import Sizes, backward, forward, hidden_for
from mc_nested.learn.dqn.compiled_engine.target_values import TargetValues, table_pays
from mc_nested.learn.dqn.engine import MLP, Batch, Engine, LastBatches, NetworkForm, UpdateRule, diverged
from mc_nested.learn.dqn.self_imitation import rival
from mc_nested.learn.dqn.states import StateParts, StateSpace

EXPONENT = np.uint32(0x7F800000)
"""The bits of a 32-bit float's exponent: all are set where a number is infinite or nan."""


class Networks(NamedTuple):
    """What updates change: the online and target networks and Adam's moments, (rows, parameters) each, and a count.

    ``updates`` is (rows,). Of one row alone: (parameters,) each, and (1,).
    """

    online: Float32s
    target: Float32s
    first_moment: Float32s
    second_moment: Float32s
    updates: Int64s


class CompiledEngine:
    """The Engine of small dense networks over numbered states.

    Args:
        space: the states and actions.
        sizes: widths of every network.
        rule: what an update does.
        online: initial parameters, (rows, parameters).
    """

    def __init__(self, space: StateSpace, sizes: Sizes, rule: UpdateRule, online: Float32s) -> None:
        self.space, self.sizes, self.rule = space, sizes, rule
        self.form = NetworkForm(MLP, sizes)
        moments = np.zeros_like(online), np.zeros_like(online)
        self._networks = Networks(online, online.copy(), *moments, np.zeros(len(online), np.int64))
        self.online, self.target, self.updates = online, self._networks.target, self._networks.updates
        tabulated = table_pays(space.count, rule.batch, rule.target_period)
        self._target_values = TargetValues(space, sizes, self.target, tabulated)
        self.last = LastBatches(len(online), rule)
        self._every_row = np.arange(len(online))
        self._widths = np.array(sizes, dtype=np.int64)
        self._acting = hidden_for(sizes, 1)
        self._parts = tuple(space.parts)
        self._learning = tuple(hidden_for(sizes, rule.batch) for _ in range(3))

    def load_online(self, online: Float32s) -> None:
        if online.shape != self.online.shape:
            raise ValueError(f"networks of {online.shape}, not {self.online.shape}")
        self.online[:] = self.target[:] = online
        self._target_values.renew(self._every_row, self.target)

    def q_values(self, states: Int64s, rows: Int64s | None = None) -> Float32s:
        named = self._every_row if rows is None else rows
        values = np.empty((len(named), self.space.actions), np.float32)
        firsts = self.space.first_of(named)
        _value(named, states, firsts, self.online, self._widths, self._parts, self._acting, values)
        return values

    def update(self, rows: Int64s, batch: Batch) -> Float32s:
        if batch.actions.shape != (len(rows), self.rule.batch):
            raise ValueError(f"batches of {batch.actions.shape}, not {(len(rows), self.rule.batch)}")
        states = self._parts, self.space.first_of(rows), self._target_values.values
        how = self._widths, tuple(self.rule), self._learning, (self.last.values, self.last.errors)
        finite, renews = _update_rows(rows, tuple(self._networks), tuple(batch), states, *how)
        if not finite:
            raise diverged(self.rule, self.updates[rows])
        if renews:
            due = rows[self.updates[rows] % self.rule.target_period == 0]
            self.target[due] = self.online[due]
            self._target_values.renew(due, self.target[due])
        return self.last.errors.take(rows, axis=0)  # a third of the time of an index of many rows

    def row(self, row: int) -> Networks:
        """Return one row's networks, uncopied, for what updates them itself."""
        return Networks._make([*(part[row] for part in self._networks[:-1]), self.updates[row : row + 1]])

    def check_finite(self, row: int, online: Float32s | None = None) -> None:
        """Raise DivergedError if a parameter of that row's online network, or of what it is to become, is no number."""
        if not np.isfinite(self.online[row] if online is None else online).all():
            raise diverged(self.rule, self.updates[row : row + 1])

    def state(self) -> dict[str, NDArray[Any]]:
        return self._networks._asdict()

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        for name, own in self.state().items():
            own[:] = state[name]
        self._target_values.renew(self._every_row, self.target)


def compiled_engine(engine: Engine) -> CompiledEngine:
    """Return that engine, whose parameters something else is to update; TypeError if it isn't the compiled one."""
    if not isinstance(engine, CompiledEngine):
        raise TypeError("the networks' parameters are only handed out by the compiled engine")
    return engine


@compiled(nogil=True)
def greedy_actions(values: Float32s, greedy: Int32s) -> None:
    """Write the first action of the highest value in each column of ``values`` (actions, batch): ``greedy``, (batch,).

    Action after action, all columns at once: that vectorises, where an argmax of each column doesn't.
    """
    greedy[:] = 0
    highest = values[0].copy()
    for action in range(1, len(values)):
        own, number = values[action], np.int32(action)
        for column in range(len(greedy)):
            higher = own[column] > highest[column]
            highest[column] = own[column] if higher else highest[column]
            greedy[column] = number if higher else greedy[column]


@compiled(nogil=True)
def td_target(reward: float, discount: float, next_value: float) -> float:
    """Return Y = r + γ Q(s', argmax Q(s'; θ); θ⁻), without the bootstrap after termination (paper, equation 4).

    ``next_value`` is the target network's value, θ⁻, of the online network's greedy action in s'.
    """
    return reward + discount * next_value


@compiled()
def _look_up(states: Int64s, first: int, parts: StateParts, inputs: Float32s) -> None:
    """Write the features of a row's states (batch,) into its network's inputs, (…, batch).

    ``first`` is where the row's states begin in the table of all states.
    """
    first_cell, first_rest = first // parts.a_cell, first // parts.a_kind * parts.a_cell
    cells, rest = parts.cells[first_cell:], parts.rest[first_rest:]
    a_cell = np.uint32(parts.a_cell)  # a division of 32 bits takes a fraction of the time of one of 64
    for column in range(len(states)):
        state = np.uint32(states[column])
        of_cell = state // a_cell
        of_rest = state - of_cell * a_cell
        for feature in range(cells.shape[1]):
            inputs[feature, column] = cells[of_cell, feature]
        for feature in range(rest.shape[1]):
            inputs[cells.shape[1] + feature, column] = rest[of_rest, feature]


@compiled()
def _value(
    rows: Int64s,
    states: Int64s,
    firsts: Int64s,
    online: Float32s,
    sizes: Int64s,
    parts: tuple[Any, ...],
    hidden: Sequence[Float32s],
    values: Float32s,
) -> None:
    """Compute ``CompiledEngine.q_values``; ``parts`` are those of StateParts."""
    inputs = np.empty((sizes[0] + 1, 1), np.float32)
    for at in range(len(rows)):
        _look_up(states[at : at + 1], firsts[at], StateParts(*parts), inputs)
        forward(online[rows[at]], sizes, inputs, hidden, values[at].reshape(-1, 1))


@compiled()
def _update_rows(
    rows: Int64s,
    of_networks: tuple[Any, ...],
    of_batch: tuple[Any, ...],
    of_states: tuple[Any, ...],
    sizes: Int64s,
    of_rule: tuple[Any, ...],
    of_work: tuple[Any, ...],
    last: tuple[Float32s, Float32s],
) -> tuple[bool, bool]:
    """Do ``CompiledEngine.update``, row by row. Compiled code takes plain tuples over in a third of named ones' time.

    ``of_states`` are the features of every state (StateParts), where each named row's begin (k,), and the targets'
    values: without a table of them, (rows, 0, actions), a batch's come from the target networks. ``of_work`` is room
    for the hidden nodes of s, of s', and of the backward pass; ``last`` are the arrays of LastBatches.

    Return whether all parameters are numbers afterwards, and whether any row's target is due.
    """
    networks, batch, rule = Networks(*of_networks), Batch(*of_batch), UpdateRule(*of_rule)
    parts, firsts, target_values = StateParts(*of_states[0]), of_states[1], of_states[2]
    hidden, next_hidden, scratch = of_work
    last_values, last_errors = last
    finite, renews = True, False
    count = batch.actions.shape[1]
    inputs = np.empty((sizes[0] + 1, count), np.float32)
    next_inputs = np.empty_like(inputs)
    values = np.empty((sizes[-1], count), np.float32)
    next_values, next_targets, slope = np.empty_like(values), np.empty_like(values), np.empty_like(values)
    gradient = np.empty(networks.online.shape[1], np.float32)
    greedy = np.empty(count, np.int32)
    bootstrap = np.empty(count, np.float32)
    tabulated = target_values.shape[1] > 0
    for at in range(len(rows)):
        row = rows[at]
        online = networks.online[row]
        _look_up(batch.states[0, at], firsts[at], parts, inputs)
        _look_up(batch.states[1, at], firsts[at], parts, next_inputs)
        if not tabulated:
            forward(networks.target[row], sizes, next_inputs, next_hidden, next_targets)
        forward(online, sizes, next_inputs, next_hidden, next_values)
        forward(online, sizes, inputs, hidden, values)
        greedy_actions(next_values, greedy)
        for column in range(count):
            best = greedy[column]
            if tabulated:
                bootstrap[column] = target_values[row, batch.states[1, at, column], best]
            else:
                bootstrap[column] = next_targets[best, column]
        slope[:] = np.float32(0)
        for column in range(count):
            action, next_value = batch.actions[at, column], bootstrap[column]
            target = td_target(batch.rewards[at, column], batch.discounts[at, column], next_value)
            error = values[action, column] - target
            last_values[row, column], last_errors[row, column] = values[action, column], error
            clipped = min(max(error, -rule.huber_delta), rule.huber_delta)
            slope[action, column] = clipped * batch.weights[at, column] / count
            if batch.imitated[at, column]:
                other = rival(values[:, column], action, rule.margin)
                if other != action:
                    slope[other, column] += np.float32(1 / count)
                    slope[action, column] -= np.float32(1 / count)
        backward(online, sizes, inputs, hidden, slope, gradient, scratch)
        networks.updates[row] += 1
        renews = renews or networks.updates[row] % rule.target_period == 0
        moments = networks.first_moment[row], networks.second_moment[row]
        adam_step(online, *moments, gradient, networks.updates[row], rule.learning_rate)
        finite = finite and all_finite(online)
    return finite, renews


@compiled()
def all_finite(values: Float32s) -> bool:
    """Return whether no value is nan or infinite, by their bits: fast mathematics may assume that none is."""
    bits = values.view(np.uint32)
    highest = np.uint32(0)
    for at in range(len(bits)):
        highest = max(highest, np.uint32(bits[at] & EXPONENT))  # of 32 bits at each step: that vectorises
    return bool(highest != EXPONENT)
