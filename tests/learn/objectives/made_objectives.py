"""Small trainings with objectives, and networks of chance."""

import math

import numpy as np

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Float32s
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.objective_training import ObjectivesTraining
from mc_nested.learn.objectives.networks import OrderNetwork, ReachNetwork
from mc_nested.learn.preset import Preset, load_preset

ANY_DESIGN = load_preset("any-design")


def small(**changed: object) -> Preset:
    """Return the preset any-design, so small that it is trained in a second or two."""
    objectives = ANY_DESIGN.objectives
    assert objectives
    rule = {"largest": 6, "most_blocks": 5, "nested_arenas": 8, "main_arenas": 4, "nested_updates": 12}
    update = {"batch": 4, "learning_starts": 16, "target_period": 5}
    main_update = objectives.main_update.model_copy(update=update)
    changes = {"episodes": 12, "evaluate_every": 6, "replay_capacity": 3000}
    return ANY_DESIGN.model_copy(
        update={
            **changes,
            "objectives": objectives.model_copy(update={**rule, "main_update": main_update, **changed}),
            "update": ANY_DESIGN.update.model_copy(update=update),
        }
    )


def training_of(scenario: Scenario, preset: Preset, seed: int = 0) -> ObjectivesTraining:
    """Return an untrained training of one run."""
    agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed)
    return ObjectivesTraining([scenario], agent, preset, seed)


def by_chance(parameters: int, seed: int) -> Float32s:
    """Return parameters of a network that learnt nothing, (parameters,)."""
    return (np.random.default_rng(seed).standard_normal(parameters) / 10).astype(np.float32)


def both_by_chance(seed: int) -> tuple[Float32s, Float32s]:
    """Return parameters of a main agent's network and of a nested agent's that learnt nothing."""
    main, nested = (
        by_chance(sum(math.prod(shape) + shape[0] for shape in network.SHAPES), seed)
        for network in (OrderNetwork, ReachNetwork)
    )
    return main, nested
