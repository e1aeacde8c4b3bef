"""A scenario from a design alone: everything else as in another scenario, with a step limit by one rule."""

from dataclasses import replace
from math import ceil

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import Scenario

FEWEST_STEPS = 60
"""The shipped designs' limit, and the lowest."""

BUILDERS_STEPS = 1.5
"""The limit of a design that takes longer, in steps of the scripted builder."""


def scenario_of_design(name: str, design: frozenset[Cell], like: Scenario) -> Scenario | None:
    """A scenario with that design, its start cell and materials those of ``like``.

    The step limit is 60, or one and a half times what the scripted builder takes, whichever is more. None if the
    builder can't build the design within it.
    """
    scenario = replace(like, name=name, design=design)
    limit = max(FEWEST_STEPS, ceil(BUILDERS_STEPS * len(build(scenario))))
    scenario = replace(scenario, step_limit=limit)
    return scenario if is_buildable(scenario) else None


def is_buildable(scenario: Scenario) -> bool:
    """Whether the scripted builder builds exactly the design within the step limit."""
    cell = scenario.start
    placed: set[Cell] = set()
    actions = build(scenario)
    for action in actions:
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        if block is not None:
            placed.add(block)
    return placed == scenario.design and len(actions) <= scenario.step_limit
