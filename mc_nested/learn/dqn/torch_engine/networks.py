"""The networks that a preset names, as torch modules: ``mlp``, ``cnn``, or anybody's own, ``my_module:make``.

Each takes states (batch, *shape) as 32-bit floats, made of what a replay keeps (features of numbered states, or planes
from 0 to 1), and gives values (batch, actions).
"""

import importlib
import math
import sys
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn.functional import embedding

from mc_nested.arrays import Float32s, Int64s
from mc_nested.errors import PresetError
from mc_nested.learn.dqn.compiled_engine.networks import Sizes, initial_parameters
from mc_nested.learn.dqn.engine import CNN, MLP, ORDER, REACH, NetworkForm
from mc_nested.learn.dqn.states import PlaneStates, States, StateSpace, numbered
from mc_nested.learn.dqn.torch_engine.objective_networks import OrderModule, ReachModule
from mc_nested.learn.dqn.torch_engine.rows import flat_of

LARGEST_SIDE_OF_SMALL = 40
"""Planes of more cells a side are pictures: they get the deep Q-network's layers for pictures (Mnih et al., 2013)."""

TRIED_WITH = (2, 3)
"""Numbers of states that somebody's own network is tried with: it has to take any."""

Make = Callable[[tuple[int, ...], int], nn.Module]
"""Makes a network for states of that shape and so many actions."""


def mlp(shape: tuple[int, ...], hidden: Sequence[int], actions: int) -> nn.Module:
    """Make dense layers: hidden ones of those widths with tanh, a linear output (paper, appendix: hyper-parameters)."""
    layers: list[nn.Module] = [nn.Flatten()] if len(shape) > 1 else []
    for inputs, outputs in pairwise((int(np.prod(shape)), *hidden, actions)):
        layers += [nn.Linear(inputs, outputs), nn.Tanh()]
    return nn.Sequential(*layers[:-1])


def cnn(shape: tuple[int, ...], hidden: Sequence[int], actions: int) -> nn.Module:
    """Make convolutions, then dense layers of the ``hidden`` widths, all with ReLU, and a linear output."""
    planes, height, width = shape
    if max(height, width) > LARGEST_SIDE_OF_SMALL:
        first, second = nn.Conv2d(planes, 16, 8, stride=4), nn.Conv2d(16, 32, 4, stride=2)
    else:
        first = nn.Conv2d(planes, 16, 3, stride=2, padding=1)
        second = nn.Conv2d(16, 32, 3, stride=2, padding=1)
    layers: list[nn.Module] = [first, nn.ReLU(), second, nn.ReLU(), nn.Flatten()]
    inputs = nn.Sequential(*layers)(torch.zeros(1, *shape)).shape[1]
    for below, above in pairwise((inputs, *hidden)):
        layers += [nn.Linear(below, above), nn.ReLU()]
    return nn.Sequential(*layers, nn.Linear(hidden[-1], actions))


def network_maker(network: str, hidden: Sequence[int]) -> Make:
    """Return what makes the network of that name, with dense layers of those widths; PresetError if there is none."""
    if network == MLP:
        return lambda shape, actions: mlp(shape, hidden, actions)
    if network == CNN:
        return lambda shape, actions: cnn(shape, hidden, actions)
    if network == REACH:
        return lambda _, actions: ReachModule(actions)
    if network == ORDER:
        return lambda _, __: OrderModule()
    return own_maker(network)


def own_maker(network: str) -> Make:
    """Return the function that ``my_module:make`` names; the working directory counts among the places of modules."""
    module_name, _, name = network.partition(":")
    if str(Path.cwd()) not in sys.path:
        sys.path.insert(0, str(Path.cwd()))
    try:
        found: Any = getattr(importlib.import_module(module_name), name)
    except (Exception, SystemExit) as error:  # it is somebody's own code
        reason = str(error).partition("\n")[0]
        raise PresetError(
            f"network {network!r}: can't be loaded ({reason}): name a module of this folder and its function"
        ) from error

    def make(shape: tuple[int, ...], actions: int) -> nn.Module:
        try:
            made: nn.Module = found(shape, actions)
            tried = ((count, made(torch.zeros(count, *shape))) for count in TRIED_WITH)
            wrong = next((why for count, values in tried if (why := _misfit(made, values, count, actions))), None)
        except (Exception, SystemExit) as error:
            reason = str(error).partition("\n")[0]
            raise PresetError(
                f"network {network!r}: fails on states of {shape} ({reason}): mend it, or name another"
            ) from error
        if wrong:
            raise PresetError(f"network {network!r}: {wrong}")
        return made

    return make


def _misfit(module: object, values: object, states: int, actions: int) -> str | None:
    """Return what keeps a module that gave these values for so many states from being a network.

    It is None if it can be one.
    """
    if not isinstance(module, nn.Module) or not isinstance(values, Tensor):
        return "its function should give a torch module, and that a tensor"
    if values.shape != (states, actions):
        return (
            f"gives {tuple(values.shape)} for {states} states: it should give ({states}, {actions}), a value an action"
        )
    if values.dtype != torch.float32 or not values.isfinite().all():
        return "gives values that are no finite 32-bit floats"
    return _untrainable(module)


def _untrainable(module: nn.Module) -> str | None:
    """Return what keeps the module's parameters from being trained as rows of networks are; None if nothing does."""
    if next(module.parameters(), None) is None:
        return "has no parameter: there is nothing to train"
    if next(module.buffers(), None) is not None:
        return "has buffers, as BatchNorm does: use layers without, as LayerNorm"
    if len(list(module.named_parameters(remove_duplicate=False))) > len(list(module.parameters())):
        return "has a parameter in two places: give each layer its own"
    if not all(part.requires_grad for part in module.parameters()):
        return "has a frozen parameter: all of a network is trained"
    return None


def form_of(network: str, shape: tuple[int, ...], hidden: Sequence[int], actions: int) -> NetworkForm:
    """Return what that network is: of dense layers alone their widths, otherwise the shape of a state before them."""
    if network == MLP:
        return NetworkForm(MLP, (int(np.prod(shape)), *hidden, actions))
    return NetworkForm(network, (*shape, *(hidden if network == CNN else ()), actions))


def initial_rows(form: NetworkForm, make: Callable[[], nn.Module], streams: Sequence[np.random.Generator]) -> Float32s:
    """Draw each row's initial parameters (rows, parameters), by its generator; an mlp's as the compiled engine's."""
    if form.network == MLP:
        sizes: Sizes = form.numbers
        return np.stack([initial_parameters(sizes, stream) for stream in streams])
    with torch.random.fork_rng():
        return np.stack([flat_of(_made_from(int(stream.integers(2**63)), make)) for stream in streams])


def _made_from(seed: int, make: Callable[[], nn.Module]) -> nn.Module:
    torch.manual_seed(seed)
    return make()


Inputs = Callable[[NDArray[Any], Int64s], Tensor]
"""From states of the named rows (k,) as a replay keeps them, (…, k, batch, *kept), to floats (…, k, batch, *shape)."""


def input_shape(states: States) -> tuple[int, ...]:
    """Return the shape of one state as a network takes it."""
    return states.planes if isinstance(states, PlaneStates) else (numbered(states).inputs,)


def inputs_of(states: States, device: torch.device) -> Inputs:
    """Return what turns those states into a network's inputs on that device."""
    if not isinstance(states, PlaneStates):
        return _features(numbered(states), device)
    if states.are_bits:
        return _bits(states.planes, device)
    return lambda kept, _: torch.from_numpy(kept).to(device).float().mul_(1 / 255)


def _bits(planes: tuple[int, ...], device: torch.device) -> Inputs:
    def unpack(kept: NDArray[Any], _: Int64s) -> Tensor:
        bits = np.unpackbits(kept, axis=-1, count=math.prod(planes)).reshape(*kept.shape[:-1], *planes)
        return torch.from_numpy(bits).to(device).float()

    return unpack


def _features(space: StateSpace, device: torch.device) -> Inputs:
    table = torch.from_numpy(space.table[:, :-1].copy()).to(device)

    def look_up(kept: NDArray[Any], rows: Int64s) -> Tensor:
        return embedding(torch.from_numpy(kept + space.first_of(rows)[:, None]).to(device), table)

    return look_up
