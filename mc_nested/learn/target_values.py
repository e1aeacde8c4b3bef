"""What the target networks say of every state there is.

A target network stands still for hundreds of updates, and the states are some thousands: valuing them all once a period
takes less than a third of the time that valuing a batch of them at every update does.
"""

from collections.abc import Sequence

import numpy as np
from numba import njit
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats, Sizes, forward, hidden_for
from mc_nested.learn.states import StateSpace

Ints = NDArray[np.int64]

AT_ONCE = 256
"""States that are valued at once: few enough for the processor's cache."""


class TargetValues:
    """The values of every state and action in each row's target network.

    ``values`` is (rows, states, actions).

    Args:
        space: the states and actions.
        sizes: widths of every network.
        target: the target networks' parameters, (rows, parameters).
    """

    def __init__(self, space: StateSpace, sizes: Sizes, target: Floats) -> None:
        self._space = space
        self._sizes = np.array(sizes, dtype=np.int64)
        self._inputs = np.zeros((space.inputs + 1, AT_ONCE), np.float32)
        self._hidden = hidden_for(sizes, AT_ONCE)
        self._some = np.empty((space.actions, AT_ONCE), np.float32)
        self.values = np.empty((space.rows, space.count, space.actions), np.float32)
        self.renew(np.arange(space.rows), target)

    def renew(self, rows: Ints, target: Floats) -> None:
        """Value every state anew in the named rows (k,), by their target networks (k, parameters)."""
        for row, parameters in zip(rows, target, strict=True):
            features = self._space.features_of(row)
            _value_all(parameters, self._sizes, features, self._inputs, self._hidden, self._some, self.values[row])


@njit(cache=True, error_model="numpy")
def _value_all(
    parameters: Floats,
    sizes: Ints,
    features: Floats,
    inputs: Floats,
    hidden: Sequence[Floats],
    some: Floats,
    values: Floats,
) -> None:
    at_once = inputs.shape[1]
    for start in range(0, len(features), at_once):
        count = min(at_once, len(features) - start)
        inputs[:, :count] = features[start : start + count].T
        forward(parameters, sizes, inputs, hidden, some)
        values[start : start + count] = some[:, :count].T
