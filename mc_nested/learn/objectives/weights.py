"""The weights of the agent with objectives: those that come with the package, and how they are written and read."""

from importlib import resources
from pathlib import Path
from typing import NamedTuple

import numpy as np
from safetensors import SafetensorError
from safetensors.numpy import load

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arrays import Float32s
from mc_nested.errors import RunError
from mc_nested.learn.dqn.states import Sees
from mc_nested.learn.objectives.decide import ObjectiveAgent

FILE = "any-design.safetensors"
"""The weights that come with the package; any-design.md says what they were trained by, and what they reach."""


class Weights(NamedTuple):
    """Both networks' parameters, (parameters,) each."""

    main: Float32s
    nested: Float32s


def shipped_file() -> Path:
    """Return where the weights that come with the package lie."""
    return Path(str(resources.files(__package__) / FILE))


def shipped_weights() -> Weights:
    """Return the weights that come with the package; RunError, one line, if they are broken."""
    try:
        arrays = load(shipped_file().read_bytes())
        weights = Weights(*(np.asarray(arrays[name], np.float32).reshape(-1) for name in Weights._fields))
        for name, parameters in weights._asdict().items():
            if not np.isfinite(parameters).all():
                raise ValueError(f"{name}: not all of it is finite")
        return weights
    except OSError as error:
        raise RunError(f"{FILE}: can't be read ({error.strerror}): install the package again") from error
    except (SafetensorError, KeyError, ValueError) as error:
        raise RunError(f"{FILE}: is broken ({error}): install the package again") from error


def agent_of(weights: Weights, scenario: Scenario, sees: Sees = "everything") -> ObjectiveAgent:
    """Return the agent with those weights; RunError, one line, if they are of another version."""
    try:
        return ObjectiveAgent(*weights, scenario, sees)
    except ValueError as error:
        raise RunError(f"{FILE}: its weights are of another version ({error}): install the package again") from error


def agent_for_cells(weights: Weights, cells: frozenset[Cell], size: int) -> ObjectiveAgent:
    """Return the agent that builds these cells of an arena of that size; RunError as ``agent_of``."""
    return agent_of(weights, Scenario("cells", cells, (0, 0), 0, (Material("any", 0.0, "any"),), size))
