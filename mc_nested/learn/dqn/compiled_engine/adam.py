"""Adam (Kingma and Ba, 2015), compiled."""

import numpy as np

from mc_nested.arrays import Float32s
from mc_nested.compiled import compiled

BETA_1, BETA_2, EPSILON = 0.9, 0.999, 1e-8
"""The constants that its authors propose."""


@compiled(fused=True)
def adam_step(
    parameters: Float32s, first: Float32s, second: Float32s, gradient: Float32s, steps: int, rate: float
) -> None:
    """Take one step of Adam by the gradient; all arrays are (parameters,), the moments' included.

    ``steps`` is the number of steps including this one.
    """
    correction = np.sqrt(1 - BETA_2**steps)
    # m / (1 - β₁ᵗ) over (√(v / (1 - β₂ᵗ)) + ε), with the corrections moved to two numbers.
    scale = np.float32(rate * correction / (1 - BETA_1**steps))
    epsilon = np.float32(EPSILON * correction)
    new_1, new_2 = np.float32(1 - BETA_1), np.float32(1 - BETA_2)
    for index in range(len(parameters)):
        slope = gradient[index]
        first[index] += new_1 * (slope - first[index])
        second[index] += new_2 * (slope * slope - second[index])
        parameters[index] -= scale * first[index] / (np.sqrt(second[index]) + epsilon)
