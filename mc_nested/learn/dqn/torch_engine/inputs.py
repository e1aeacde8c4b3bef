"""What a torch network takes for the states that a replay keeps: features of numbered states, or planes from 0 to 1."""

from collections.abc import Callable
from typing import Any

import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.nn.functional import embedding

from mc_nested.arrays import Int64s
from mc_nested.learn.dqn.state_space import StateSpace
from mc_nested.learn.dqn.states import States

Inputs = Callable[[NDArray[Any], Int64s], Tensor]
"""From states of the named rows (k,) as a replay keeps them, (…, k, batch, *kept), to floats (…, k, batch, *shape)."""


def input_shape(states: States) -> tuple[int, ...]:
    """The shape of one state as a network takes it."""
    return (states.inputs,) if isinstance(states, StateSpace) else states.shape


def inputs_of(states: States, device: torch.device) -> Inputs:
    """What turns those states into a network's inputs on that device."""
    if isinstance(states, StateSpace):
        return _features(states, device)
    return lambda kept, _: torch.from_numpy(kept).to(device).float().mul_(1 / 255)


def _features(space: StateSpace, device: torch.device) -> Inputs:
    table = torch.from_numpy(space.table[:, :-1].copy()).to(device)

    def look_up(kept: NDArray[Any], rows: Int64s) -> Tensor:
        return embedding(torch.from_numpy(kept + space.first_of(rows)[:, None]).to(device), table)

    return look_up
