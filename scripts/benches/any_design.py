"""How many designs the shipped networks build whole at the first try, and in how many steps against the builder's.

The designs are those that `mc-nested study benchmark --seed 2026` draws, three hundred of another seed, those shipped,
and a hundred of 20 to 100 blocks each in arenas of 20 and of 30 cells. Nothing was trained on them, or chosen by them.
--run judges a training's networks instead, and with --ship they become the package's.
"""

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypedDict

import numpy as np
from rich.console import Console
from rich.progress import track

from mc_nested.arena.builder import build
from mc_nested.arena.random_designs import FEW_BLOCKS, random_scenario
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.learn.objectives.decide import built_by_the_rules
from mc_nested.learn.objectives.weights import Weights, agent_of, save_weights, shipped_file, shipped_weights
from mc_nested.learn.runs.run_folder import RunFolder
from scripts.bench import Figures

MANY_BLOCKS = 20, 100

MOST_STEPS = 1.15
"""Steps against the scripted builder's, the median over the designs that were built whole."""


def drawn(seed: int, designs: int, size: int = 15, blocks: tuple[int, int] = FEW_BLOCKS) -> list[Scenario]:
    """Return so many designs of that seed, in arenas of that size; the start is the middle of the far edge."""
    like = load_scenario("line")
    if size != like.size:
        like = replace(like, size=size, start=(size // 2, size - 1), design=frozenset())
    return [random_scenario(seed, number, like, blocks) for number in range(designs)]


def topics(designs: int, seed: int) -> Iterator[tuple[str, list[Scenario], float, float]]:
    """Yield each topic's name, its designs, the share of them to be built whole, and the most steps."""
    yield f"designs of seed {seed}", drawn(seed, designs), 0.97, MOST_STEPS
    yield f"designs of seed {seed + 1}", drawn(seed + 1, 3 * designs), 0.97, MOST_STEPS
    yield "shipped", [load_scenario(name) for name in shipped_scenarios()], 1.0, MOST_STEPS
    yield "arenas of 20", drawn(seed, designs, 20, MANY_BLOCKS), 0.95, math.inf
    yield "arenas of 30", drawn(seed, designs, 30, MANY_BLOCKS), 0.90, math.inf


class Judged(TypedDict):
    """A topic's figures."""

    whole: int
    of: int
    steps_against_the_builder: float
    failed: list[str]


def judged(name: str, scenarios: Sequence[Scenario], weights: Weights) -> Judged:
    """Return how many of those designs are built whole, and in how many of the scripted builder's steps."""
    shares, failed = [], []
    for scenario in track(scenarios, name, console=Console(stderr=True)):
        placed, steps = built_by_the_rules(agent_of(weights, scenario), scenario)
        if placed == scenario.design:
            shares.append(steps / len(build(scenario)))
        else:
            failed.append(f"{scenario.name} {len(placed & scenario.design)} of {scenario.blocks}")
    return {
        "whole": len(shares),
        "of": len(scenarios),
        "steps_against_the_builder": round(float(np.median(shares)), 3) if shares else math.inf,
        "failed": failed,
    }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--designs", type=int, default=100, help="of each topic; three times as many of another seed")
    parser.add_argument("--seed", type=int, default=2026, help="of the designs")
    parser.add_argument("--run", type=Path, help="judge the networks of this training's folder")
    parser.add_argument("--ship", action="store_true", help="with --run: put its networks into the package")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Let the networks build every design once."""
    weights = shipped_weights()
    if options.run:
        networks = RunFolder.open(options.run).policies()
        weights = Weights(networks["main"][0], networks["low"][0])
    figures: dict[str, Judged] = {}
    is_right = True
    for name, scenarios, least, most in topics(options.designs, options.seed):
        figures[name] = found = judged(name, scenarios, weights)
        is_right &= found["whole"] >= least * found["of"] and found["steps_against_the_builder"] <= most
    if options.run and options.ship:
        save_weights(weights, shipped_file())
    return figures, is_right
