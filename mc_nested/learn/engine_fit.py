"""Which engine, network, states and ways to explore go together in a preset."""

from typing import NamedTuple

from mc_nested.learn.dqn.engines import COMPILED

NUMBERS = "numbers"
"""An agent that sees x, y, b and its choice; otherwise it sees planes (arena/planes.py)."""

MLP, CNN, CPU = "mlp", "cnn", "cpu"


class Computing(NamedTuple):
    """What a preset says about what it sees, and what computes it."""

    engine: str
    device: str
    network: str
    states: str


def misfit(computing: Computing, *, explores_by_place: bool, imagines: bool, encoding: str) -> str | None:
    """What doesn't go together, one line; None if all does."""
    engine, device, network, states = computing
    compiled, numbers = engine == COMPILED, states == NUMBERS
    rules = {
        f'states "{states}" need engine "torch": the compiled engine takes numbers alone': compiled and not numbers,
        f'network "{network}" needs engine "torch": the compiled engine has "mlp" alone': compiled and network != MLP,
        f'device "{device}" needs engine "torch": the compiled engine is for the processor': compiled and device != CPU,
        'network "cnn" needs states "image": numbers have no neighbours': network == CNN and numbers,
        '[imagination] needs engine "compiled" and states "numbers"': imagines and not (compiled and numbers),
        f'[excursions] go by x and y: with states "{states}", write [explore_nested]': explores_by_place
        and not numbers,
        f'encoding "{encoding}" is for states "numbers": leave it out': encoding != "scaled" and not numbers,
        f'network "{network}": write "mlp", "cnn", or a module and its function, "my_module:make"': (
            network not in (MLP, CNN) and ":" not in network
        ),
    }
    return next((says for says, is_broken in rules.items() if is_broken), None)
