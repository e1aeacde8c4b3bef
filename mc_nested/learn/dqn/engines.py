"""The engine that a preset names, with its networks as they begin; and what goes together with it in a preset."""

from collections.abc import Sequence
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
    return _made_torch_engine(states, choice, rule, streams)


def _made_torch_engine(
    states: States, choice: EngineChoice, rule: UpdateRule, streams: Sequence[np.random.Generator]
) -> Engine:
    try:  # it takes 200 MB, which the compiled engine doesn't need
        from mc_nested.learn.dqn.torch_engine import engine, networks
    except ImportError as error:
        raise PresetError('engine "torch": torch is missing: install torch, or take --engine compiled') from error
    device = engine.device_named(choice.device)
    shape = networks.input_shape(states)
    form = networks.form_of(choice.network, shape, choice.hidden, states.actions)
    make = networks.network_maker(choice.network, choice.hidden)
    online = networks.initial_rows(form, lambda: make(shape, states.actions), streams)
    return engine.TorchEngine(states, form, lambda: make(shape, states.actions), rule, online, device)


NUMBERS, SCREEN, OBJECTIVES = "numbers", "screen", "objectives"
"""What an agent sees: x, y, b and its choice; the game's window; an objective and what stands around (objectives/).

Otherwise planes (arena/planes.py).
"""

MLP, CNN, CPU = "mlp", "cnn", "cpu"

REACH, ORDER = "reach", "order"
"""The networks of the agents with objectives: the nested agent's, and the main agent's."""


def misfit(choice: EngineChoice, states: str, *, explores_by_place: bool, imagines: bool, encoding: str) -> str | None:
    """Return what in a preset doesn't go together with what computes it, one line; None if all does."""
    engine, device, network, _ = choice
    compiled, numbers = engine == COMPILED, states == NUMBERS
    rules = {
        f'states "{states}" need engine "torch": the compiled engine takes numbers alone': compiled and not numbers,
        f'network "{network}" needs engine "torch": the compiled engine has "mlp" alone': compiled and network != MLP,
        f'device "{device}" needs engine "torch": the compiled engine is for the processor': compiled and device != CPU,
        'states "objectives" and network "reach" go together': (states == OBJECTIVES) != (network == REACH),
        'network "cnn" needs states "image" or "screen": numbers have no neighbours': network == CNN and numbers,
        '[imagination] needs engine "compiled" and states "numbers"': imagines and not (compiled and numbers),
        f'[excursions] go by x and y: with states "{states}", write [explore_nested]': explores_by_place
        and not numbers,
        f'encoding "{encoding}" is for states "numbers": leave it out': encoding != "scaled" and not numbers,
        f'network "{network}": write "mlp", "cnn", or a module and its function, "my_module:make"': (
            network not in (MLP, CNN, REACH) and ":" not in network
        ),
    }
    return next((says for says, is_broken in rules.items() if is_broken), None)
