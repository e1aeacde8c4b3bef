"""How many designs the shipped networks build whole at the first try, and in how many steps against the builder's.

The designs are those that `mc-nested study benchmark --seed 2026` draws, three hundred of another seed, those shipped,
and a hundred of 20 to 100 blocks each in arenas of 20 and of 30 cells. Nothing was trained on them, or chosen by them.
--run judges a training's networks instead, and with --ship they become the package's. --main puts something simpler in
the main agent's place: the nearest cell to build, or any, by chance. --window also builds the first few of them with
keys and clicks, in a rehearsal window that is calibrated first, and compares with the client's world.
"""

import argparse
import json
import math
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypedDict

import numpy as np
import tomlkit
from rich.console import Console
from rich.progress import track
from safetensors.numpy import save

from mc_nested.arena.builder import build
from mc_nested.arena.design import FEW_BLOCKS, random_scenario
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios, table_of
from mc_nested.arrays import Bools, Float32s
from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError
from mc_nested.learn.dqn.nearness import spread
from mc_nested.learn.dqn.states import AGENT, NONE, OCCUPIED, WANTED, Sees
from mc_nested.learn.objectives.decide import ObjectiveAgent, built_by_the_rules
from mc_nested.learn.objectives.weights import Weights, agent_of, shipped_file, shipped_weights
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.profile.store import load_profile
from scripts.bench import Figures
from scripts.benches.rehearsal import prepare
from scripts.rehearsal_window import mc_nested, open_rehearsal
from scripts.window_display import open_display

MANY_BLOCKS = 20, 100

MOST_STEPS = 1.15
"""Steps against the scripted builder's, the median over the designs that were built whole."""

PASSING = np.float32(0.95)
"""What is left of a nearness after a step: still a number after as many as a path can have."""

Order = Callable[[Bools], Float32s]
"""What each cell (R, side, side) is worth as the next one, from the main agent's planes; NONE if it isn't wanted."""


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


class TopicFigures(TypedDict):
    """A topic's figures; there are no steps where none was built whole."""

    whole: int
    of: int
    steps_against_the_builder: float | None
    failed: list[str]


def nearest(planes: Bools) -> Float32s:
    """Return an Order: the fewer steps to where a cell is built from, the more it is worth; 0 if there is no way."""
    near, _ = spread(planes[:, AGENT].astype(np.float32), np.where(planes[:, OCCUPIED], np.float32(0), PASSING))
    worth: Float32s = np.where(planes[:, WANTED], np.roll(near, 1, axis=2), NONE)
    return worth


def by_chance(seed: int) -> Order:
    """Return an Order by chance, another one each time it is asked; the same from the same seed."""
    random = np.random.default_rng(seed)
    return lambda planes: np.where(planes[:, WANTED], random.random(planes[:, WANTED].shape, np.float32), NONE)


IN_PLACE: Mapping[str, Callable[[int], Order]] = {"nearest": lambda _: nearest, "chance": by_chance}
"""What can be in the main agent's place, from a seed."""


def trained(run: Path) -> tuple[Weights, Sees]:
    """Return a training's networks, and what its nested agent is shown; RunError if it has no objectives."""
    folder = RunFolder.open(run)
    rule = folder.config.preset.objectives
    if rule is None or folder.config.design_unknown:
        raise RunError(f"{run}: its networks know no objectives: name a training with the preset any-design")
    networks = folder.policies()
    return Weights(networks["main"][0], networks["low"][0]), rule.nested_sees


def figures_of(shares: Sequence[float], failed: list[str]) -> TopicFigures:
    """Return the figures of designs built whole, in these shares of the scripted builder's steps, and of the others."""
    return {
        "whole": len(shares),
        "of": len(shares) + len(failed),
        "steps_against_the_builder": round(float(np.median(shares)), 3) if shares else None,
        "failed": failed,
    }


def judged(name: str, scenarios: Sequence[Scenario], agent_for: Callable[[Scenario], ObjectiveAgent]) -> TopicFigures:
    """Return how many of those designs are built whole, and in how many of the scripted builder's steps."""
    shares, failed = [], []
    for scenario in track(scenarios, name, console=Console(stderr=True)):
        placed, steps, _ = built_by_the_rules(agent_for(scenario), scenario)
        if placed == scenario.design:
            shares.append(steps / len(build(scenario)))
        else:
            failed.append(f"{scenario.name} {len(placed & scenario.design)} of {scenario.blocks}")
    return figures_of(shares, failed)


def built_in_the_window(scenarios: Sequence[Scenario]) -> TopicFigures:
    """Return how many of those designs are built whole in a calibrated rehearsal window, without a block elsewhere."""
    failed, shares = [], []
    with (
        signals_as_exit(),
        tempfile.TemporaryDirectory(prefix="mc-nested-any-design-") as temporary,
        open_display() as env,
        open_rehearsal(env, Path(temporary)) as window,
    ):
        profile = Path(temporary) / "profile.toml"
        mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, env=env)
        arena = load_profile(profile).marked_arena()
        for scenario in track(scenarios, "in the window", console=Console(stderr=True)):
            file = Path(temporary) / f"{scenario.name}.toml"
            file.write_text(tomlkit.dumps(table_of(scenario).model_dump(exclude_none=True)), encoding="utf-8")
            live = ("--backend", "live", "--profile", profile, "--json")
            found = json.loads(mc_nested("build", file, "--agent", *live, env=env))
            stands = window.truth.standing(arena)
            wanted = {arena.block_of(cell) for cell in scenario.design}
            if stands.keys() == wanted and found["score"] == found["optimum"]:
                shares.append(found["steps"] / len(build(scenario)))
            else:
                wrong = len(stands.keys() - wanted)
                failed.append(f"{scenario.name} {found['built']} of {scenario.blocks}, {wrong} elsewhere")
    return figures_of(shares, failed)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--designs", type=int, default=100, help="of each topic; three times as many of another seed")
    parser.add_argument("--seed", type=int, default=2026, help="of the designs, and of chance")
    parser.add_argument("--window", type=int, default=0, help="of the first topic, built in a rehearsal window, too")
    parser.add_argument("--main", choices=IN_PLACE, help="what chooses the next cell in the main agent's place")
    parser.add_argument("--run", type=Path, help="judge the networks of this training's folder")
    parser.add_argument("--ship", action="store_true", help="with --run: put its networks into the package")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Let the networks build every design once."""
    weights, sees = trained(options.run) if options.run else (shipped_weights(), "everything")
    if options.ship and sees != "everything":
        raise RunError(f"--ship {options.run}: its nested agent sees the {sees} alone: ship one that sees everything")

    def agent_for(scenario: Scenario) -> ObjectiveAgent:
        agent = agent_of(weights, scenario, sees)
        if options.main:
            agent.order = IN_PLACE[options.main](options.seed)
        return agent

    figures: dict[str, TopicFigures] = {}
    is_right = True
    for name, scenarios, least, most in topics(options.designs, options.seed):
        figures[name] = found = judged(name, scenarios, agent_for)
        is_right &= found["whole"] >= least * found["of"] and (found["steps_against_the_builder"] or 0) <= most
    if options.window:
        prepare(Console(stderr=True).print)
        figures["in the window"] = found = built_in_the_window(drawn(options.seed, options.window))
        is_right &= found["whole"] == found["of"]
    if options.run and options.ship:
        with atomic_write(shipped_file()) as unfinished:
            unfinished.write_bytes(save(weights._asdict()))
    return figures, is_right
