"""The engine that a preset names, with its networks as they begin."""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from mc_nested.errors import PresetError
from mc_nested.learn.dqn.compiled_engine.engine import CompiledEngine
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters
from mc_nested.learn.dqn.engine import Engine, UpdateRule
from mc_nested.learn.dqn.states import States, StateSpace

COMPILED, TORCH = "compiled", "torch"


class EngineChoice(NamedTuple):
    """What computes: the engine and its device, the network's name, and the nodes of each dense layer."""

    engine: str
    device: str
    network: str
    hidden: Sequence[int]


def made_engine(
    states: States, choice: EngineChoice, rule: UpdateRule, streams: Sequence[np.random.Generator]
) -> Engine:
    """Return the engine, with a network for each generator, from which its first parameters come.

    PresetError if there is no such network or device, or torch is missing.
    """
    if choice.engine == COMPILED and isinstance(states, StateSpace):
        sizes = states.network(choice.hidden)
        return CompiledEngine(states, sizes, rule, np.stack([initial_parameters(sizes, stream) for stream in streams]))
    try:  # it takes 200 MB, which the compiled engine doesn't need
        from mc_nested.learn.dqn.torch_engine import engine, networks
    except ModuleNotFoundError as error:
        raise PresetError('engine "torch": torch is missing: install torch, or take --engine compiled') from error
    except (ImportError, OSError) as error:  # a part of it, as of another computer's, isn't there
        raise PresetError(
            f'engine "torch": torch can\'t be loaded, {error}: reinstall it, or take --engine compiled'
        ) from error
    device = engine.device_named(choice.device)
    shape = networks.input_shape(states)
    form = networks.form_of(choice.network, shape, choice.hidden, states.actions)
    make = partial(networks.network_maker(choice.network, choice.hidden), shape, states.actions)
    return engine.TorchEngine(states, form, make, rule, networks.initial_rows(form, make, streams), device)


NUMBERS, SCREEN, OBJECTIVES = "numbers", "screen", "objectives"
"""What an agent sees: x, y, b and its choice; the game's window; an objective and what stands around (objectives/).

Otherwise planes (arena/planes.py).
"""
