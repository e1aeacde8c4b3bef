"""Networks as a user may bring them: one that fits, and some that don't."""

import sys

import torch
from torch import Tensor, nn


def pooled(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Make a network that fits any states."""
    size = torch.zeros(shape).numel()
    return nn.Sequential(nn.Flatten(), nn.LayerNorm(size), nn.Linear(size, actions))


def one_value(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - that's what is wrong with it
    """Make a network that doesn't give a value for each action."""
    return nn.Sequential(nn.Flatten(), nn.Linear(torch.zeros(shape).numel(), 1))


def normed(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Make a network with buffers."""
    size = torch.zeros(shape).numel()
    return nn.Sequential(nn.Flatten(), nn.BatchNorm1d(size), nn.Linear(size, actions))


def for_pictures(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Make a network that only takes planes."""
    return nn.Sequential(nn.Conv2d(shape[0], 1, 3), nn.Flatten(), nn.LazyLinear(actions))


class Fails(nn.Module):
    """A network that fails whenever it is called."""

    def forward(self, _: Tensor) -> Tensor:
        raise RuntimeError("no idea\nat all")


def fails(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - it never gets that far
    """Make a network that can't be called."""
    return Fails()


class Halves(nn.Linear):
    """A network that gives floats of 16 bits."""

    def forward(self, states: Tensor) -> Tensor:
        return super().forward(states).half()


def halves(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Return a network whose values can't be compared with the rewards."""
    return Halves(shape[0], actions)


class ForTwo(nn.Linear):
    """A network that takes exactly two states."""

    def forward(self, states: Tensor) -> Tensor:
        return super().forward(states.reshape(2, -1))


def for_two(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Make a network that fails on a batch."""
    return ForTwo(shape[0], actions)


def without_parameters(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - it takes any
    """Make a network without parameters."""
    return nn.AdaptiveAvgPool1d(actions)


def leaves(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - it never gets that far
    """End the program."""
    sys.exit(5)


class Recurrent(nn.Module):
    """A recurrent layer over the numbers of a state."""

    def __init__(self, actions: int) -> None:
        super().__init__()
        self.memory = nn.GRU(1, 4, batch_first=True)
        self.unused = nn.Linear(1, 1)
        self.last = nn.Linear(4, actions)

    def forward(self, states: Tensor) -> Tensor:
        seen, _ = self.memory(states[..., None])
        values: Tensor = self.last(seen[:, -1])
        return values


def recurrent(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - it takes numbers, however many
    """Make a network that can't be stacked, and one layer of which is never used."""
    return Recurrent(actions)


def dropped(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Make a network that draws random numbers."""
    return nn.Sequential(nn.Flatten(), nn.Dropout(0.1), nn.Linear(torch.zeros(shape).numel(), actions))


def tied(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Return a network with one parameter in two layers."""
    size = torch.zeros(shape).numel()
    first, second = nn.Linear(size, size), nn.Linear(size, size)
    second.weight = first.weight
    return nn.Sequential(nn.Flatten(), first, second, nn.Linear(size, actions))


def frozen(shape: tuple[int, ...], actions: int) -> nn.Module:
    """Return a network with a layer that isn't to be trained."""
    module = nn.Sequential(nn.Flatten(), nn.Linear(torch.zeros(shape).numel(), actions))
    module[1].bias.requires_grad_(False)
    return module


def nothing(shape: tuple[int, ...], actions: int) -> None:
    """Return None instead of a module."""
