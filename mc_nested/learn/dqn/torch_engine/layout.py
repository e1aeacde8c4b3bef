"""Where a module's parameters lie in a flat row: a dense layer as the compiled engine's, each node's bias last.

So an mlp of one engine can be handed to the other, and a checkpoint or an optimiser step is one array.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import torch
from torch import Tensor, nn

from mc_nested.arrays import Float32s

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


def laid_out(parts: Sequence[Tensor], slots: Sequence[Slot], rows: int) -> Tensor:
    """Return rows (rows, parameters) of the parameters (rows, *shape) of every slot, in its order."""
    each = iter(parts)
    lying = []
    for slot in slots:
        part = next(each)
        if len(slot.names) > 1:
            weights = part.reshape(rows, slot.shape[0], -1)
            part = torch.cat((weights, next(each).reshape(rows, slot.shape[0], 1)), dim=-1)
        lying.append(part.reshape(rows, -1))
    return torch.cat(lying, dim=1)


def bind(module: nn.Module, row: Tensor) -> None:
    """Make the module's parameters views of the row (parameters,): a change there is a change of the module."""
    own = dict(module.named_parameters())
    for name, part in parts_of(row, slots_of(module)).items():
        own[name].data = part


def flat_of(module: nn.Module) -> Float32s:
    """Return a module's parameters as one row (parameters,)."""
    slots, own = slots_of(module), dict(module.named_parameters())
    return laid_out([own[name] for slot in slots for name in slot.names], slots, 1)[0].detach().numpy()
