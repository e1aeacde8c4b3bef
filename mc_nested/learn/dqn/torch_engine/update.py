"""What an update does by hand: the slopes of its loss in the values Q(s, a), and Adam's step for rows of parameters.

Autograd does the rest: it begins at the network's output. Adam (Kingma and Ba, 2015) is as the compiled engine's.
"""

import math

import numpy as np
import torch
from torch import Tensor

from mc_nested.arrays import Int64s
from mc_nested.learn.dqn.compiled_engine.adam import BETA_1, BETA_2, EPSILON
from mc_nested.learn.dqn.engine import UpdateRule


def huber_slopes(values: Tensor, taken: Tensor, errors: Tensor, weights: Tensor, rule: UpdateRule) -> Tensor:
    """Return the slope of each value (k, batch, actions) in the mean Huber loss: the error, at most δ either way.

    ``taken`` (k, batch, 1) are the actions; ``errors`` (k, batch) are Q(s, a) less its goal, times ``weights``.
    """
    own = errors.clamp(-rule.huber_delta, rule.huber_delta).mul_(weights).mul_(1 / rule.batch)
    return torch.zeros_like(values).scatter_(-1, taken, own.unsqueeze(-1))


def margin_slopes(values: Tensor, taken: Tensor, imitated: Tensor, rule: UpdateRule) -> Tensor:
    """Return the slope of each value (k, batch, actions) in the mean large-margin loss of what is imitated (k, batch).

    The loss (self_imitation.py) rises with the rival's value, and falls with that of the action that was taken; where
    they are the same, it is flat.
    """
    share = (imitated / rule.batch).unsqueeze(-1)
    rival = (values + rule.margin).scatter_(-1, taken, values.gather(-1, taken)).argmax(-1, keepdim=True)
    return torch.zeros_like(values).scatter_add_(-1, rival, share).scatter_add_(-1, taken, -share)


def adam_step(parameters: Tensor, first: Tensor, second: Tensor, gradient: Tensor, steps: Int64s, rate: float) -> None:
    """Take one step by the gradient, in place; all (rows, parameters), but ``steps`` (rows,), which count this one."""
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
    """Return the rate and ε with the corrections of both moments in them."""
    correction = math.sqrt(1 - BETA_2**step)
    return rate * correction / (1 - BETA_1**step), EPSILON * correction
