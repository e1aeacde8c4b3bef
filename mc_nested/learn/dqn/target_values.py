"""The target networks' values of every possible state.

A target network is fixed for hundreds of updates, and there are a few thousand states. Computing all their values once
a period takes less than a third of the time of computing those of a batch at every update.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.learn.dqn.compiled import compiled
from mc_nested.learn.dqn.networks import Sizes, forward, hidden_for
from mc_nested.learn.dqn.state_space import StateSpace

AT_ONCE = 256
"""States whose values are computed at once: few enough for the processor's cache."""


class TargetValues:
    """The values of every state and action in each row's target network.

    ``values`` is (rows, states, actions).

    Args:
        space: the states and actions.
        sizes: widths of every network.
        target: the target networks' parameters, (rows, parameters).
    """

    def __init__(self, space: StateSpace, sizes: Sizes, target: Float32s) -> None:
        self._space = space
        self._sizes = np.array(sizes, dtype=np.int64)
        self._inputs = np.zeros((space.inputs + 1, AT_ONCE), np.float32)
        self._hidden = hidden_for(sizes, AT_ONCE)
        self._some = np.empty((space.actions, AT_ONCE), np.float32)
        self.values = np.empty((space.rows, space.count, space.actions), np.float32)
        self.renew(np.arange(space.rows), target)

    def renew(self, rows: Int64s, target: Float32s) -> None:
        """Recompute the values of every state in the named rows (k,), by their target networks (k, parameters)."""
        for row, parameters in zip(rows, target, strict=True):
            features = self._space.features_of(row)
            _value_all(parameters, self._sizes, features, self._inputs, self._hidden, self._some, self.values[row])


@compiled()
def _value_all(
    parameters: Float32s,
    sizes: Int64s,
    features: Float32s,
    inputs: Float32s,
    hidden: Sequence[Float32s],
    some: Float32s,
    values: Float32s,
) -> None:
    at_once = inputs.shape[1]
    for start in range(0, len(features), at_once):
        count = min(at_once, len(features) - start)
        inputs[:, :count] = features[start : start + count].T
        forward(parameters, sizes, inputs, hidden, some)
        values[start : start + count] = some[:, :count].T
