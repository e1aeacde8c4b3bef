"""Adam (Kingma and Ba, 2015) for rows of parameters, each at a step of its own: as the compiled engine's."""

import numpy as np
import torch
from torch import Tensor

from mc_nested.arrays import Int64s
from mc_nested.learn.dqn.compiled_engine.adam import BETA_1, BETA_2, EPSILON


def adam_step(parameters: Tensor, first: Tensor, second: Tensor, gradient: Tensor, steps: Int64s, rate: float) -> None:
    """One step by the gradient, in place; all (rows, parameters), but ``steps`` (rows,), which count this one."""
    correction = np.sqrt(1 - BETA_2**steps)
    scales = np.stack((-rate * correction / (1 - BETA_1**steps), EPSILON * correction))
    scale, epsilon = torch.from_numpy(scales.astype(np.float32)).to(parameters.device)[..., None]
    first.lerp_(gradient, 1 - BETA_1)
    second.mul_(BETA_2).addcmul_(gradient, gradient, value=1 - BETA_2)
    parameters.addcdiv_(scale * first, second.sqrt().add_(epsilon))
