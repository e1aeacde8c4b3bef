"""Rows of networks of one form, whose parameters are one tensor: one row by autograd, several stacked by torch.func."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import torch
from torch import Tensor, nn
from torch.func import functional_call, vmap

from mc_nested.arrays import Int64s


class Values(NamedTuple):
    """Values (k, batch, actions), and the parameters that they depend on: leaves for autograd, (k, …) or one row's."""

    values: Tensor
    leaves: Sequence[Tensor]


class NetworkRows:
    """Networks whose parameters are the rows of ``flat`` (rows, parameters): a change there is a change of them.

    Args:
        make: makes one network, on the device of ``flat``.
        flat: the parameters.
        stacks: whether several rows are computed at once, and not one after the other.
    """

    def __init__(self, make: Callable[[], nn.Module], flat: Tensor, stacks: bool = True) -> None:
        self._flat = flat
        self._stacks = stacks
        self._modules = [_bound(make(), row) for row in flat]
        self._shapes = {name: part.shape for name, part in self._modules[0].named_parameters()}
        self._every = len(flat)
        first = self._modules[0]
        self._stacked = vmap(lambda parameters, inputs: functional_call(first, parameters, (inputs,)))

    def values(self, rows: Int64s, inputs: Tensor) -> Values:
        """The values of inputs (k, batch, …) in the named rows (k,)."""
        if len(rows) == 1 or not self._stacks:
            modules = [self._modules[row] for row in rows]
            values = [module(own) for module, own in zip(modules, inputs, strict=True)]
            leaves = [part for module in modules for part in module.parameters()]
            return Values(values[0][None] if len(rows) == 1 else torch.stack(values), leaves)
        named = self._flat if len(rows) == self._every else self._flat[torch.from_numpy(rows)]
        parameters = self._parts_of(named)
        return Values(self._stacked(parameters, inputs), list(parameters.values()))

    def gradient(self, loss: Tensor, leaves: Sequence[Tensor], rows: int) -> Tensor:
        """The gradient of the loss in so many rows, (rows, parameters), from the leaves that ``values`` gave."""
        slopes = torch.autograd.grad(loss, leaves)
        if len(slopes) == len(self._shapes):
            return torch.cat([slope.reshape(rows, -1) for slope in slopes], dim=1)
        return torch.cat([slope.reshape(-1) for slope in slopes]).reshape(rows, -1)

    def _parts_of(self, flat: Tensor) -> dict[str, Tensor]:
        """Each parameter of the rows (k, parameters), (k, *its shape), as a leaf of its own."""
        parts, start = {}, 0
        for name, shape in self._shapes.items():
            end = start + shape.numel()
            parts[name] = flat[:, start:end].view(-1, *shape).detach().requires_grad_()
            start = end
        return parts


def _bound(module: nn.Module, row: Tensor) -> nn.Module:
    """The module, its parameters being parts of the row (parameters,)."""
    start = 0
    for part in module.parameters():
        end = start + part.numel()
        part.data = row[start:end].view(part.shape)
        start = end
    return module
