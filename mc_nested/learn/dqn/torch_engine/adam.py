"""Adam (Kingma and Ba, 2015) for rows of parameters, each at a step of its own: as the compiled engine's."""

import math

import numpy as np
import torch
from torch import Tensor

from mc_nested.arrays import Int64s
from mc_nested.learn.dqn.compiled_engine.adam import BETA_1, BETA_2, EPSILON


def adam_step(parameters: Tensor, first: Tensor, second: Tensor, gradient: Tensor, steps: Int64s, rate: float) -> None:
    """One step by the gradient, in place; all (rows, parameters), but ``steps`` (rows,), which count this one."""
    first.lerp_(gradient, 1 - BETA_1)
    second.mul_(BETA_2).addcmul_(gradient, gradient, value=1 - BETA_2)
    if (steps == steps[0]).all():
        scale, epsilon = _scales(int(steps[0]), rate)
        parameters.addcdiv_(first, second.sqrt().add_(epsilon), value=-scale)
        return
    scales = np.array([_scales(int(own), rate) for own in steps], np.float32)
    own_scale, own_epsilon = torch.from_numpy(scales).to(parameters.device).T[..., None]
    parameters.addcdiv_(own_scale * first, second.sqrt().add_(own_epsilon), value=-1)


def _scales(step: int, rate: float) -> tuple[float, float]:
    """The rate and ε with the corrections of both moments in them."""
    correction = math.sqrt(1 - BETA_2**step)
    return rate * correction / (1 - BETA_1**step), EPSILON * correction
