"""Double deep Q-learning (paper, section 2.4) for many independent networks at once.

A row is one learner: an online and a target network, its optimiser's moments and its count of updates. Rows never
meet: updating some of them leaves the others untouched.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from mc_nested.learn.adam import Moments, adam_step
from mc_nested.learn.imitation import margin_slope
from mc_nested.learn.networks import Activations, Floats, Sizes, backward, forward, split

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
    """Transitions for k rows: actions, rewards and discounts (k, batch), and the features of their states.

    ``inputs`` (2, k, inputs + 1, batch) holds every s and behind them every s', each column ending in a 1;
    ``discounts`` is what the value of s' counts: γ, or 0 where the episode terminated. ``imitated`` (k, batch) says
    which actions are to be the greedy ones, if any are; ``weights`` (k, batch) what each error counts, if not 1.
    """

    inputs: Floats
    actions: NDArray[np.integer[Any]]
    rewards: Floats
    discounts: Floats
    imitated: Bools | None = None
    weights: Floats | None = None


def td_targets(rewards: Floats, discounts: Floats, next_online: Floats, next_target: Floats) -> Floats:
    """Y = r + γ Q(s', argmax Q(s'; θ); θ⁻), the bootstrap dropped where the episode terminated (paper, equation 4).

    ``next_online`` and ``next_target`` are the two networks' values of s', (k, actions, batch); the rest (k, batch).
    """
    chosen = torch.max(torch.from_numpy(next_online), 1).indices.numpy()  # along this axis faster than any argmax
    return rewards + discounts * next_target.reshape(-1).take(places_of(chosen, next_target.shape))


class DDQN:
    """Rows of Q-networks with their targets and optimisers.

    Args:
        sizes: widths of every network.
        rule: what an update does.
        online: initial parameters, (rows, parameters).
    """

    def __init__(self, sizes: Sizes, rule: UpdateRule, online: Floats) -> None:
        self.sizes = sizes
        self.rule = rule
        self.updates: Ints = np.zeros(len(online), dtype=np.int64)
        self._learners = _Learners(online, online.copy(), Moments(np.zeros_like(online), np.zeros_like(online)))
        self._last_values = np.full((len(online), rule.batch), np.nan, np.float32)
        self._last_errors = np.full((len(online), rule.batch), np.nan, np.float32)
        self._acting = Activations((len(online),), 1, sizes)
        self._all_rows = _Workspace(self._learners, sizes, rule.batch)
        self._some_rows: dict[int, _Workspace] = {}

    @property
    def online(self) -> Floats:
        """The online networks' parameters, (rows, parameters)."""
        return self._learners.online

    @property
    def target(self) -> Floats:
        """The target networks' parameters, (rows, parameters)."""
        return self._learners.target

    def take_over(self, online: Floats) -> None:
        """Go on from other networks (rows, parameters), the targets too; ValueError where their shape differs."""
        if online.shape != self.online.shape:
            raise ValueError(f"networks of {online.shape}, not {self.online.shape}")
        self.online[:] = self.target[:] = online

    def q_values(self, inputs: Floats, rows: Ints | None = None) -> Floats:
        """The online networks' values (k, actions) of a state a row, inputs (k, inputs + 1, 1); of all rows by default.

        Without ``rows`` the array is overwritten by the next call.
        """
        if rows is None:
            return forward(self._all_rows.online_layers, inputs, self._acting)[..., 0]
        layers = split(self.online[rows], self.sizes)
        return forward(layers, inputs, Activations((len(rows),), 1, self.sizes))[..., 0]

    def update_all(self, batch: Batch, active: Bools) -> Floats:
        """One update of each active row (rows,), each on its own part of the batch, which has a part for every row.

        Returns the TD errors, (rows, batch).
        """
        self.updates += active
        values, errors = _update(self._all_rows, batch, self.rule, self.updates, active)
        self._take_note(np.flatnonzero(active), values[active], errors[active])
        return errors

    def update_some(self, rows: Ints, batch: Batch) -> Floats:
        """One update of each of the named rows (k,), each on its own part of the batch; the TD errors, (k, batch)."""
        work = self._some_rows.get(len(rows))
        if work is None:
            work = self._some_rows[len(rows)] = _Workspace(self._learners.of(rows), self.sizes, self.rule.batch)
        for own, copy in zip(self._learners.arrays(), work.learners.arrays(), strict=True):
            own.take(rows, axis=0, out=copy, mode="clip")  # "clip" writes straight into the copy
        self.updates[rows] += 1
        values, errors = _update(work, batch, self.rule, self.updates[rows], np.ones(len(rows), dtype=np.bool_))
        self._take_note(rows, values, errors)
        for own, copy in zip(self._learners.arrays(), work.learners.arrays(), strict=True):
            own[rows] = copy
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
        moments = self._learners.moments
        return {
            "online": self.online,
            "target": self.target,
            "first_moment": moments.first,
            "second_moment": moments.second,
            "updates": self.updates,
        }

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        for name, own in self.state().items():
            own[:] = state[name]

    def _take_note(self, rows: Ints, values: Floats, errors: Floats) -> None:
        self._last_values[rows], self._last_errors[rows] = values, errors


@dataclass(frozen=True)
class _Learners:
    """What an update changes, (rows, parameters) each."""

    online: Floats
    target: Floats
    moments: Moments

    def arrays(self) -> tuple[Floats, ...]:
        return self.online, self.target, self.moments.first, self.moments.second

    def of(self, rows: Ints) -> "_Learners":
        moments = Moments(self.moments.first[rows], self.moments.second[rows])
        return _Learners(self.online[rows], self.target[rows], moments)


class _Workspace:
    """Learners and the standing arrays that their update works in."""

    def __init__(self, learners: _Learners, sizes: Sizes, batch: int) -> None:
        rows = len(learners.online)
        self.learners = learners
        self.gradient = np.empty_like(learners.online)
        self.now_and_next = Activations((2, rows), batch, sizes)
        self.target_next = Activations((rows,), batch, sizes)
        self.scratch = [np.empty((rows, width, batch), np.float32) for width in sizes[1:-1]]
        self.online_layers = split(learners.online, sizes)
        self.target_layers = split(learners.target, sizes)
        self.gradient_layers = split(self.gradient, sizes)


def _update(work: _Workspace, batch: Batch, rule: UpdateRule, updates: Ints, active: Bools) -> tuple[Floats, Floats]:
    values, errors = _find_gradient(work, batch, rule)
    adam_step(work.learners.online, work.learners.moments, work.gradient, updates, rule.learning_rate, active)
    due = active & (updates % rule.target_period == 0)
    if due.any():
        work.learners.target[due] = work.learners.online[due]
    return values, errors


def _find_gradient(work: _Workspace, batch: Batch, rule: UpdateRule) -> tuple[Floats, Floats]:
    values, next_online = forward(work.online_layers, batch.inputs, work.now_and_next)
    next_target = forward(work.target_layers, batch.inputs[1], work.target_next)
    targets = td_targets(batch.rewards, batch.discounts, next_online, next_target)
    taken = places_of(batch.actions, values.shape)
    own: Floats = values.reshape(-1).take(taken)
    errors: Floats = own - targets
    slope = np.clip(errors, -rule.huber_delta, rule.huber_delta) / np.float32(rule.batch)
    if batch.weights is not None:
        slope *= batch.weights
    output_gradient = next_target  # its values are used up
    output_gradient.fill(0.0)
    output_gradient.reshape(-1)[taken] = slope
    if batch.imitated is not None:
        towards = margin_slope(values, batch.actions, rule.margin) * batch.imitated[:, None]
        output_gradient += towards / np.float32(rule.batch)
    now = [hidden[0] for hidden in work.now_and_next.hidden]
    backward(work.online_layers, batch.inputs[0], now, output_gradient, work.gradient_layers, work.scratch)
    return own, errors


def places_of(actions: NDArray[np.integer[Any]], shape: tuple[int, ...]) -> Ints:
    """Where the values of those actions (k, batch) lie in a flat array of the shape (k, actions, batch)."""
    places: Ints = actions * np.int64(shape[2])
    places += _first_places(shape)
    return places


@cache
def _first_places(shape: tuple[int, ...]) -> Ints:
    rows, width, batch = shape
    return np.arange(rows)[:, None] * (width * batch) + np.arange(batch)
