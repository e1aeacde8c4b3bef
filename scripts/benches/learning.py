"""Updates a second of many runs at once, compared with single-run loops.

The same work: the line in the simulator, one environment step and one DDQN update of batch 32 per step, two hidden
layers of 32, Adam. Each contestant uses all cores: our runs are divided over the cores as in ``mc-nested reproduce``,
and each core runs one single-run loop. All take turns in short slices, so that a drift in the machine's speed affects
them equally; quote the ratios. The torch engine takes part with one run and with the most, its images with one and ten;
stable-baselines3 where the bench extra is installed.
"""

import argparse
import importlib.util
import itertools
import multiprocessing
import os
import statistics
import tempfile
import time
from collections.abc import Sequence
from contextlib import ExitStack
from multiprocessing.connection import Connection

import torch
from rich.console import Console
from rich.progress import track

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from scripts.bench import Figures
from scripts.benches.single_run_loops import Slices, plain_loop, sb3
from sim.grid import GridVectorEnv

LINE, PAPER = load_scenario("line"), load_preset("paper")
WARM_UP_S = 1.0
PRESETS = {"compiled": PAPER, "torch": PAPER.changed(engine="torch"), "images": load_preset("image")}
"""What this project's trainer is measured with, by the word before the number of runs."""
IMAGE_RUNS = (1, 10)
MOST_RUNS = 90
"""The runs of the paper's experiment: the ratios are quoted for this number if it is measured."""


def ours(runs: int, preset: Preset) -> Slices:
    """Return this project's trainer with that many runs; the main agent's updates are left out of the count.

    Where all runs have had their episodes, others begin.
    """
    seeds = itertools.count()
    trainer = trainer_of(runs, preset, next(seeds))

    def work() -> int:
        nonlocal trainer
        if trainer.finished:
            trainer = trainer_of(runs, preset, next(seeds))
        before = int(trainer.agent.low_level.engine.updates.sum())
        for _ in range(20):
            trainer.tick()
        return int(trainer.agent.low_level.engine.updates.sum()) - before

    return work


def trainer_of(runs: int, preset: Preset, seed: int) -> Trainer:
    """Return that many runs of the nested agent on the line."""
    scenarios = [LINE] * runs
    agent = Agent(AGENT_SPECS["nested"], scenarios, preset, seed)
    return Trainer(agent.view_of(GridVectorEnv(scenarios), scenarios), scenarios, agent, preset, seed)


def matrix_products(runs: int) -> Slices:
    """Return the products of the hidden layer alone, as one bmm; counted in FLOPs, in thousands."""
    width, columns = PAPER.hidden[0], 2 * PAPER.update.batch
    weights, states = torch.randn(runs, width, width), torch.randn(runs, width, columns)
    out = torch.empty(runs, width, columns)

    def work() -> int:
        for _ in range(50):
            torch.bmm(weights, states, out=out)
        return 50 * 2 * runs * width * width * columns // 1000

    return work


def flops_of_an_update() -> int:
    """Count the multiplications and additions in an update's matrix products of the nested agent (paper, equation 4).

    Forward pass: s and s' in the online network, s' in the target network. Backward pass: the gradient of every weight,
    and of every layer's input but the first layer's.
    """
    layers = list(itertools.pairwise((4, *PAPER.hidden, 8)))
    passes = sum((5 if layer else 4) * inputs * outputs for layer, (inputs, outputs) in enumerate(layers))
    return 2 * PAPER.update.batch * passes


def contestant(name: str, core: int, cores: int) -> Slices | None:
    """Return the work of the process on that core for a contestant; None if it has none."""
    if name == "plain loop":
        return plain_loop()
    if name == "stable-baselines3":
        return sb3()
    if name == "bmm":
        return matrix_products(MOST_RUNS // cores)
    if name == "plain loop, one":
        return plain_loop() if core == 0 else None
    kind, count = name.split()
    runs = int(count) // cores + (core < int(count) % cores)
    return ours(runs, PRESETS[kind]) if runs else None


def on_a_core(pipe: Connection, names: Sequence[str], core: int, cores: int) -> None:
    """Serve as a process of its own: for each contestant and seconds that come in, send its updates a second."""
    torch.set_num_threads(1)
    work = {name: contestant(name, core, cores) for name in names}
    while (task := pipe.recv()) is not None:
        name, seconds = task
        slices = work[name]
        pipe.send(rate(slices, seconds) if slices else 0.0)


def rate(work: Slices, seconds: float) -> float:
    """Return the updates a second over at least that long."""
    began, updates = time.perf_counter(), 0
    while (took := time.perf_counter() - began) < seconds:
        updates += work()
    return updates / took


def ours_named(runs: Sequence[int]) -> list[str]:
    """Return the contestants of this project: what it is measured with (PRESETS), and so many runs."""
    torch_runs = sorted({1, max(runs)})
    counts = {"compiled": runs, "torch": torch_runs, "images": [count for count in IMAGE_RUNS if count <= max(runs)]}
    return [f"{kind} {count}" for kind, own in counts.items() for count in own]


def rates_of(runs: Sequence[int], rounds: int, slice_s: float, cores: int) -> dict[str, list[float]]:
    """Return the updates a second of each contestant on all cores together, a figure a round."""
    names = [*ours_named(runs), "plain loop", "plain loop, one", "bmm"]
    if importlib.util.find_spec("stable_baselines3"):
        names.append("stable-baselines3")
    context = multiprocessing.get_context("spawn")
    os.environ["OMP_NUM_THREADS"] = "1"
    with ExitStack() as ends:
        # torch makes a folder among the temporary files; each system has its own variable for where they are.
        scratch = ends.enter_context(tempfile.TemporaryDirectory(prefix="mc-nested-bench-"))
        os.environ.update(dict.fromkeys(("TMPDIR", "TEMP", "TMP"), scratch))
        pipes = []
        for core in range(cores):
            here, there = context.Pipe()
            process = context.Process(target=on_a_core, args=(there, names, core, cores), daemon=True)
            process.start()
            ends.callback(process.join)
            ends.callback(here.send, None)
            pipes.append(here)
        rates: dict[str, list[float]] = {name: [] for name in names}
        for measured in track(range(-1, rounds), "rounds", console=Console(stderr=True)):
            for name in names:
                for pipe in pipes:
                    pipe.send((name, slice_s if measured >= 0 else WARM_UP_S))
                together = sum(pipe.recv() for pipe in pipes)
                if measured >= 0:
                    rates[name].append(together)
    return rates


def ratio(rates: dict[str, list[float]], one: str, other: str) -> float:
    """Return how many times as fast the one is as the other: the median over the rounds."""
    return statistics.median(a / b for a, b in zip(rates[one], rates[other], strict=True))


def summary(rates: dict[str, list[float]], runs: Sequence[int], cores: int) -> Figures:
    """Return the figures as one JSON object; every ratio at the largest number of runs but ``ratio_one_run``."""
    medians = {name: statistics.median(found) for name, found in rates.items()}
    most, has_sb3 = f"compiled {max(runs)}", "stable-baselines3" in rates
    limit = medians["bmm"] * 1000 / flops_of_an_update()
    return {
        "cores": cores,
        "ours": {name: round(medians[name]) for name in ours_named(runs)},
        "plain_loop": round(medians["plain loop"]),
        "sb3": round(medians["stable-baselines3"]) if has_sb3 else None,
        "limit": round(limit),
        "ratio_sb3": round(ratio(rates, most, "stable-baselines3"), 1) if has_sb3 else None,
        "ratio_plain_loop": round(ratio(rates, most, "plain loop"), 1),
        "ratio_limit": round(medians[most] / limit, 3),
        "ratio_one_run": round(ratio(rates, "compiled 1", "plain loop, one"), 2) if 1 in runs else None,
        "ratio_torch": round(ratio(rates, f"torch {max(runs)}", "plain loop"), 1),
        "ratio_torch_one_run": round(ratio(rates, "torch 1", "plain loop, one"), 2),
    }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--runs", type=int, nargs="+", default=[1, 10, 30, MOST_RUNS], help="how many at once")
    parser.add_argument("--rounds", type=int, default=5, help="each is measured so often, by turns")
    parser.add_argument("--slice-s", type=float, default=2.0, help="seconds of a turn")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Let every contestant learn, by turns; nothing is judged."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    rates = rates_of(options.runs, options.rounds, options.slice_s, cores)
    return summary(rates, options.runs, cores), True
