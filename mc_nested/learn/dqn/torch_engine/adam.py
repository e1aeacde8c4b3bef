"""Adam (Kingma and Ba, 2015) for rows of parameters, each at a step of its own: as the compiled engine's."""

import torch
from torch import Tensor

from mc_nested.learn.dqn.compiled_engine.adam import BETA_1, BETA_2, EPSILON


def adam_step(parameters: Tensor, first: Tensor, second: Tensor, gradient: Tensor, steps: Tensor, rate: float) -> None:
    """One step by the gradient, in place; all (rows, parameters), but ``steps`` (rows, 1), which count this one."""
    first.lerp_(gradient, 1 - BETA_1)
    second.mul_(BETA_2).addcmul_(gradient, gradient, value=1 - BETA_2)
    correction = torch.sqrt(1 - BETA_2**steps)
    scale = rate * correction / (1 - BETA_1**steps)
    parameters.sub_(scale * first / (second.sqrt().add_(EPSILON * correction)))
