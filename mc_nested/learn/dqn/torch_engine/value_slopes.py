"""The slopes of an update's loss in the values Q(s, a), by hand: autograd begins at the network's output."""

import torch
from torch import Tensor

from mc_nested.learn.dqn.engine import UpdateRule


def huber_slopes(values: Tensor, taken: Tensor, errors: Tensor, weights: Tensor, rule: UpdateRule) -> Tensor:
    """The slope of each value (k, batch, actions) in the mean Huber loss: the error, at most δ either way.

    ``taken`` (k, batch, 1) are the actions; ``errors`` (k, batch) are Q(s, a) less its goal, times ``weights``.
    """
    own = errors.clamp(-rule.huber_delta, rule.huber_delta).mul_(weights).mul_(1 / rule.batch)
    return torch.zeros_like(values).scatter_(-1, taken, own.unsqueeze(-1))


def margin_slopes(values: Tensor, taken: Tensor, imitated: Tensor, rule: UpdateRule) -> Tensor:
    """The slope of each value (k, batch, actions) in the mean large-margin loss of what is imitated (k, batch).

    The loss (self_imitation.py) rises with the rival's value, and falls with that of the action that was taken; where
    they are the same, it is flat.
    """
    share = (imitated / rule.batch).unsqueeze(-1)
    rival = (values + rule.margin).scatter_(-1, taken, values.gather(-1, taken)).argmax(-1, keepdim=True)
    return torch.zeros_like(values).scatter_add_(-1, rival, share).scatter_add_(-1, taken, -share)
