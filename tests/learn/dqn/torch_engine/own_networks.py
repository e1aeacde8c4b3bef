"""Networks as somebody brings them: one that fits, and some that don't."""

import torch
from torch import Tensor, nn


def pooled(shape: tuple[int, ...], actions: int) -> nn.Module:
    """It fits any states."""
    size = torch.zeros(shape).numel()
    return nn.Sequential(nn.Flatten(), nn.LayerNorm(size), nn.Linear(size, actions))


def one_value(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - that's what is wrong with it
    """It doesn't give a value for each action."""
    return nn.Sequential(nn.Flatten(), nn.Linear(torch.zeros(shape).numel(), 1))


def normed(shape: tuple[int, ...], actions: int) -> nn.Module:
    """It has buffers."""
    size = torch.zeros(shape).numel()
    return nn.Sequential(nn.Flatten(), nn.BatchNorm1d(size), nn.Linear(size, actions))


def for_pictures(shape: tuple[int, ...], actions: int) -> nn.Module:
    """It only takes planes."""
    return nn.Sequential(nn.Conv2d(shape[0], 1, 3), nn.Flatten(), nn.LazyLinear(actions))


class Fails(nn.Module):
    """It fails whenever it is asked."""

    def forward(self, _: Tensor) -> Tensor:
        raise RuntimeError("no idea\nat all")


def fails(shape: tuple[int, ...], actions: int) -> nn.Module:  # noqa: ARG001 - it never gets that far
    """It can't be called."""
    return Fails()
