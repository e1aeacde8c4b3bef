"""Rows of networks of one form, whose parameters are one tensor: one row by autograd, several stacked by torch.func.

A dense layer lies in its row as the compiled engine's, each node's bias last. So an mlp of one engine can be handed to
the other, and a checkpoint or an optimiser step is one array.
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import torch
from torch import Tensor, nn
from torch.func import functional_call, vmap

from mc_nested.arrays import Float32s, Int64s

BOTH = {"weight", "bias"}
"""The parameters of a dense layer as it usually is."""


class Slot(NamedTuple):
    """Parameters that lie together: one, or a dense layer's weights and biases."""

    names: tuple[str, ...]
    shape: tuple[int, ...]


def slots_of(module: nn.Module) -> tuple[Slot, ...]:
    """Return the slots of a module's parameters, in the order of the module."""
    slots = []
    for path, part in module.named_modules():
        own = {f"{path}.{name}".lstrip("."): each for name, each in part.named_parameters(recurse=False)}
        if isinstance(part, nn.Linear) and {name for name, _ in part.named_parameters(recurse=False)} == BOTH:
            slots.append(Slot(tuple(own), (part.out_features, part.in_features + 1)))
        else:
            slots += [Slot((name,), tuple(each.shape)) for name, each in own.items()]
    return tuple(slots)


def parts_of(rows: Tensor, slots: Sequence[Slot]) -> dict[str, Tensor]:
    """Return views of each parameter in the rows (…, parameters), (…, *its shape), by name."""
    parts, start = {}, 0
    for slot in slots:
        end = start + math.prod(slot.shape)
        lying = rows[..., start:end].view(*rows.shape[:-1], *slot.shape)
        if len(slot.names) == 1:
            parts[slot.names[0]] = lying
        else:
            parts[slot.names[0]], parts[slot.names[1]] = lying[..., :-1], lying[..., -1]
        start = end
    return parts


def bind(module: nn.Module, row: Tensor) -> None:
    """Make the module's parameters views of the row (parameters,): a change there is a change of the module."""
    own = dict(module.named_parameters())
    for name, part in parts_of(row, slots_of(module)).items():
        own[name].data = part


def flat_of(module: nn.Module) -> Float32s:
    """Return a copy of a module's parameters as one row (parameters,)."""
    own = dict(module.named_parameters())
    row = torch.empty(sum(each.numel() for each in own.values()))
    for name, part in parts_of(row, slots_of(module)).items():
        part.copy_(own[name].detach())
    return row.numpy()


class Values(NamedTuple):
    """Values (k, batch, actions), and the parameters that they depend on, for autograd.

    ``leaves`` are each parameter of all k rows (k, …), or those of one row after the other.
    """

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
        self._modules = [make() for _ in flat]
        for module, row in zip(self._modules, flat, strict=True):
            bind(module, row)
        self._every = np.arange(len(flat))
        self._slots = slots_of(self._modules[0])
        names = [name for slot in self._slots for name in slot.names]
        self._leaves = [[dict(module.named_parameters())[name] for name in names] for module in self._modules]
        self._gradient = torch.zeros_like(flat)
        self._slopes = list(parts_of(self._gradient, self._slots).values())
        self._slopes_of = [list(parts_of(row, self._slots).values()) for row in self._gradient]
        first = self._modules[0]
        self._stacked = vmap(lambda parameters, inputs: functional_call(first, parameters, (inputs,)))

    def values(self, rows: Int64s, inputs: Tensor) -> Values:
        """Return the values of inputs (k, batch, …) in the named rows (k,)."""
        if len(rows) == 1:
            return Values(self._modules[rows[0]](inputs[0])[None], self._leaves[rows[0]])
        if not self._stacks:
            values = [self._modules[row](own) for row, own in zip(rows, inputs, strict=True)]
            return Values(torch.stack(values), [leaf for row in rows for leaf in self._leaves[row]])
        named = self._flat if np.array_equal(rows, self._every) else self._flat[torch.from_numpy(rows)]
        leaves = {name: part.detach().requires_grad_() for name, part in parts_of(named, self._slots).items()}
        return Values(self._stacked(leaves, inputs), list(leaves.values()))

    def gradient(self, values: Tensor, slopes: Tensor, leaves: Sequence[Tensor], rows: int) -> Tensor:
        """Return the gradient (rows, parameters) of a loss with these slopes in the values (rows, batch, actions).

        ``leaves`` are as ``values`` gave them. The next call writes over what this one returns.
        """
        found = torch.autograd.grad(values, leaves, slopes, allow_unused=True)
        stacked = rows > 1 and len(leaves) == len(self._leaves[0])
        one_by_one = (part for row in self._slopes_of[:rows] for part in row)
        for slope, part in zip(found, (part[:rows] for part in self._slopes) if stacked else one_by_one, strict=True):
            if slope is None:
                part.zero_()
            else:
                part.copy_(slope)
        return self._gradient[:rows]


def can_be_stacked(module: nn.Module, shape: tuple[int, ...]) -> bool:
    """Return whether torch.func can compute several rows of such a module at once, from states of that shape.

    It can't with a recurrent layer, or with one that draws random numbers.
    """
    rows = {name: torch.stack((part.detach(), part.detach())) for name, part in module.named_parameters()}
    try:
        vmap(lambda parameters, inputs: functional_call(module, parameters, (inputs,)))(rows, torch.zeros(2, 1, *shape))
    except Exception:  # whatever torch or the module says
        return False
    return True
