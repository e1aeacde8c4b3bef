"""Engine: the seam between a learner and what computes its networks' values and updates.

Two engines stand behind it. The compiled one (compiled_engine/) is for small dense networks over numbered states. The
torch one (torch_engine/) takes any module and any observation. A row is one learner: an online and a target network,
its optimiser's moments and its count of updates. Rows are independent.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Bools, Float32s, Int64s, Integers
from mc_nested.errors import DivergedError


class UpdateRule(NamedTuple):
    """What an update does (docs/explanation/task.md): batch size, Adam's rate, the target's period and Huber's δ.

    ``margin`` is that of imitated actions (self_imitation.py).
    """

    batch: int
    learning_rate: float
    target_period: int
    huber_delta: float
    margin: float = 0.0


class Batch(NamedTuple):
    """Transitions for k rows: states (2, k, batch, …), actions, rewards and discounts (k, batch).

    ``states`` holds every s, and every s', as a replay keeps them; ``discounts`` is the factor of the value of s': γ,
    or 0 where the episode terminated. ``imitated`` (k, batch) marks the actions that should become greedy;
    ``weights`` (k, batch) scale the errors.
    """

    states: Integers
    actions: Integers
    rewards: Float32s
    discounts: Float32s
    imitated: Bools
    weights: Float32s


def lesson(states: Int64s, actions: Int64s, values: Float32s) -> Batch:
    """Return a batch for one row, of what actions are worth in states, (batch,) each, whatever follows."""
    none = np.zeros((1, len(actions)), np.float32)
    both = np.stack((states, states))[:, None]
    return Batch(both, actions[None], values[None], none, none.astype(np.bool_), np.ones_like(none))


MLP, CNN, REACH, ORDER = "mlp", "cnn", "reach", "order"
"""Networks that a preset names; the last two are those of the agents with objectives: the nested and the main one."""


class NetworkForm(NamedTuple):
    """What a network is: its name in a preset, and its numbers. Networks of one form can be exchanged."""

    network: str
    numbers: tuple[int, ...]


class Engine(Protocol):
    """Rows of Q-networks with their targets and optimisers (paper, section 2.4)."""

    updates: Int64s
    """Updates that each row has had, (rows,)."""

    rule: UpdateRule
    """What an update does; another learning rate may be given on the way."""

    last: "LastBatches"
    """What each row's last update found."""

    form: NetworkForm
    """What each network is."""

    @property
    def online(self) -> Float32s:
        """The online networks' parameters, (rows, parameters): to be read, not written."""

    @property
    def target(self) -> Float32s:
        """The target networks' parameters, (rows, parameters): to be read, not written."""

    def q_values(self, states: NDArray[Any], rows: Int64s | None = None) -> Float32s:
        """Return the online networks' values (k, actions) of one kept state for each named row (k,), or for all."""

    def update(self, rows: Int64s, batch: Batch) -> Float32s:
        """Update each of the named rows (k,), each on its own part of the batch; return the TD errors, (k, batch).

        An update follows the gradient of the mean Huber loss, and of the mean large-margin loss of what is
        imitated. DivergedError if a parameter is no number afterwards, before anything can be saved.
        """

    def load_online(self, online: Float32s) -> None:
        """Continue with other networks (rows, parameters), the targets too; ValueError if their shape differs."""

    def state(self) -> Arrays:
        """Return what the next update depends on, by name, (rows, …) each."""

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""


class LastBatches:
    """What each row's last update found: Q(s, a) before it and the TD errors, (rows, batch) each; nan at first.

    Args:
        rows: how many rows.
        rule: what an update does.
    """

    def __init__(self, rows: int, rule: UpdateRule) -> None:
        self.values = np.full((rows, rule.batch), np.nan, np.float32)
        self.errors = np.full((rows, rule.batch), np.nan, np.float32)
        self._delta = np.float32(rule.huber_delta)

    def loss(self) -> Float32s:
        """Return the mean Huber loss of each row, (rows,)."""
        size = np.abs(self.errors)
        losses = np.where(size <= self._delta, size**2 / 2, self._delta * (size - self._delta / 2))
        mean: Float32s = losses.mean(axis=1)
        return mean

    def q(self) -> Float32s:
        """Return the mean of the values of each row, (rows,)."""
        mean: Float32s = self.values.mean(axis=1)
        return mean


def diverged(rule: UpdateRule, updates: Int64s) -> DivergedError:
    """Return the error of networks that hold what is no number after so many updates (k,)."""
    return DivergedError(
        f"learning_rate {rule.learning_rate:g} is too high: after {updates.max()} updates the "
        f"networks hold what is no number: lower it in the preset's [update], and train again"
    )
