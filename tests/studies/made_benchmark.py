"""A made-up benchmark: two contestants on designs of every kind, one of which fails on some."""

from dataclasses import replace

import numpy as np

from mc_nested.arena.design import random_scenario
from mc_nested.studies.arm import Arm
from mc_nested.studies.trial import Trial
from tests.studies.made_trials import LINE, PAPER, made_arm, made_trial

DESIGNS = 12
SCENARIOS = [random_scenario(4, number, LINE) for number in range(DESIGNS)]


def contestant(preset: str, most: int, trials: int = 2, designs: int = DESIGNS) -> Arm:
    whole = PAPER.model_copy(update={"episodes": most})
    arm = made_arm(f"nested, {preset}", SCENARIOS[:designs], trials, preset_name=preset)
    return replace(arm, preset=whole)


def played(arm: Arm, design: int, number: int, episodes: int | None, seconds: float = 1.0) -> Trial:
    """Return a trial that was at the optimum after so many episodes, or never: then it lacks three blocks."""
    scenario = SCENARIOS[design]
    scores = [(episodes - 1, scenario.optimum)] if episodes else [(60, scenario.optimum - 3)]
    return made_trial(arm, scenario, number, scores, seconds=seconds)


def made_benchmark() -> list[Trial]:
    random = np.random.default_rng(3)
    quick, slow = contestant("quick", 100), contestant("sl|ow", 3000)
    trials = [
        played(quick, design, number, int(random.integers(5, 30)), 1.0 + 2 * (design % 2))
        for design in range(DESIGNS)
        for number in range(2)
    ]
    return trials + [
        played(slow, design, number, None if random.random() < 0.4 else int(random.integers(60, 900)), 20.0)
        for design in range(DESIGNS)
        for number in range(2)
    ]
