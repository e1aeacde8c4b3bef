"""Adam (Kingma and Ba, 2015) on many parameter vectors side by side, some of which may stand still.

torch's operations do it in place on the arrays' own memory: a fused step each where NumPy would need two or three.
"""

from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats

BETA_1, BETA_2, EPSILON = 0.9, 0.999, 1e-8
"""The constants that its authors propose."""


@dataclass(frozen=True)
class Moments:
    """Running means of the gradient and of its square, (rows, parameters) each."""

    first: Floats
    second: Floats


def adam_step(
    parameters: Floats,
    moments: Moments,
    gradient: Floats,
    steps: NDArray[np.int64],
    rate: float,
    active: NDArray[np.bool_],
) -> None:
    """One step of each active row (rows,), by its gradient (rows, parameters), which is overwritten.

    ``steps`` (rows,) counts each row's steps, this one included. A row that isn't active stays as it is to the bit.
    """
    moves = active.astype(np.float64)
    taken = np.maximum(steps, 1)
    correction_1, correction_2 = 1 - BETA_1**taken, np.sqrt(1 - BETA_2**taken)
    # m / (1 - β₁ᵗ) over (√(v / (1 - β₂ᵗ)) + ε), with the corrections moved to numbers of a row.
    scale = _column(moves * rate * correction_2 / correction_1)
    epsilon = _column(EPSILON * correction_2)
    own, first, second, slope = (torch.from_numpy(a) for a in (parameters, moments.first, moments.second, gradient))
    first.lerp_(slope, _column(moves * (1 - BETA_1)))
    second.lerp_(slope.mul_(slope), _column(moves * (1 - BETA_2)))
    step = torch.sqrt(second, out=slope).add_(epsilon)
    own.sub_(torch.div(first, step, out=step).mul_(scale))


def _column(values: NDArray[np.float64]) -> torch.Tensor:
    return torch.from_numpy(values.astype(np.float32)[:, None])
