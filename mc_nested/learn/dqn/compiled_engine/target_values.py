"""The target networks' values: of every possible state once a period, or of a batch's next states at every update.

A target network is fixed for hundreds of updates, and in a usual arena there are a few thousand states. Computing all
their values once a period takes less time than computing those of each batch. Where there are many more states (a
hundred blocks, eight materials), it takes more, and a batch's are computed when they are needed.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.networks import Sizes, forward, hidden_for
from mc_nested.learn.dqn.states import StateSpace

AT_ONCE = 256
"""States whose values are computed at once: few enough for the processor's cache."""


def table_pays(states: int, batch: int, target_period: int) -> bool:
    """Return whether a target period's updates value at least as many states as there are: each costs the same."""
    return states <= batch * target_period


class TargetValues:
    """The values of every state and action in each row's target network.

    ``values`` is (rows, states, actions); without a table, (rows, 0, actions).

    Args:
        space: the states and actions.
        sizes: widths of every network.
        target: the target networks' parameters, (rows, parameters).
        tabulated: whether there is a table of all states.
    """

    def __init__(self, space: StateSpace, sizes: Sizes, target: Float32s, tabulated: bool = True) -> None:
        self._space = space
        self._sizes = np.array(sizes, dtype=np.int64)
        self._hidden = hidden_for(sizes, AT_ONCE)
        self.values = np.empty((space.rows, space.count if tabulated else 0, space.actions), np.float32)
        self.renew(np.arange(space.rows), target)

    def renew(self, rows: Int64s, target: Float32s) -> None:
        """Recompute the values of every state in the named rows (k,), by their target networks (k, parameters)."""
        if not self.values.size:
            return
        for row, parameters in zip(rows, target, strict=True):
            _value_all(parameters, self._sizes, self._space.features_of(row), self._hidden, self.values[row])


@compiled()
def _value_all(
    parameters: Float32s, sizes: Int64s, features: Float32s, hidden: Sequence[Float32s], values: Float32s
) -> None:
    inputs = np.zeros((features.shape[1], AT_ONCE), np.float32)
    some = np.empty((values.shape[1], AT_ONCE), np.float32)
    for start in range(0, len(features), AT_ONCE):
        count = min(AT_ONCE, len(features) - start)
        inputs[:, :count] = features[start : start + count].T
        forward(parameters, sizes, inputs, hidden, some)
        values[start : start + count] = some[:, :count].T
