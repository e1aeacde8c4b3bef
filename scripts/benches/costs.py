"""Seconds that a training takes, the paper's three agents by turns: what claims (i) are judged by.

The paper, section 5.2, of nested and hierarchical: "we avoided having to train separate neural networks for each action
of the main agent, which was less computationally expensive". Of all three: nested "outperformed" the others "in terms
of training stability, converged score, and computational expense".

A turn is a whole training of the paper's designs by one agent, all its trials as one batch in this process, so that all
batches are of one size. A round has a turn of each agent, in another order each round and with a seed of its own. A
short training of each agent comes first: what it takes longer than one after it is compiling. Nested is quicker where a
sign-flip test over the rounds shows that its seconds are below nine tenths of the other's, slower where they are shown
to be above ten ninths.
"""

import argparse
import math
import time

import numpy as np
from rich.console import Console
from rich.progress import track

from mc_nested.arena.scenario_file import load_scenario, paper_scenarios
from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.studies.claims.contests import HIERARCHICAL, NESTED, SINGLE
from mc_nested.studies.inference import ALPHA, exceeds, mean_interval, within
from scripts.bench import Figures
from sim.grid import GridVectorEnv

CLEAR = math.log(10 / 9)
"""A ratio of seconds counts from here on, as its logarithm."""

SHORT = 30
"""Episodes of a training that compiles everything."""


def seconds_of_training(agent: str, trials: int, episodes: int, seed: int) -> float:
    """Train so many trials of that agent on each of the paper's designs as one batch; return the thread's seconds."""
    scenarios = [load_scenario(name) for name in paper_scenarios() for _ in range(trials)]
    preset = load_preset("paper").changed(episodes=episodes)
    learner = Agent(AGENT_SPECS[agent], scenarios, preset, seed)
    trainer = Trainer(learner.view_of(GridVectorEnv(scenarios), scenarios), scenarios, learner, preset, seed)
    began = time.thread_time()
    while not trainer.finished:
        trainer.tick()
    return time.thread_time() - began


def compared(ours: list[float], theirs: list[float]) -> Figures:
    """Return nested's seconds as a share of the other's, a figure of each a round, with interval and verdict."""
    shares = np.log(np.array(ours)) - np.log(np.array(theirs))
    ends = mean_interval(shares)
    is_quicker, is_slower = exceeds(-shares, CLEAR), exceeds(shares, CLEAR)
    verdict = "holds" if is_quicker < ALPHA else "does not hold" if is_slower < ALPHA else "undecided"
    if verdict == "undecided" and within(shares, CLEAR) < ALPHA:
        verdict += ", within a tenth"
    return {
        "ratio": round(float(np.exp(shares.mean())), 3),
        "low": round(math.exp(ends.low), 3) if ends else None,
        "high": round(math.exp(ends.high), 3) if ends else None,
        "verdict": verdict,
    }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--trials", type=int, default=10, help="of each agent on each design, as one batch")
    parser.add_argument("--episodes", type=int, default=3000, help="of a training")
    parser.add_argument("--rounds", type=int, default=5, help="each agent trains so often, by turns")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Let the agents train by turns."""
    if options.trials < 1 or options.episodes < 1 or options.rounds < 1:
        raise UserError("--trials, --episodes and --rounds take 1 or more")
    agents = [NESTED, HIERARCHICAL, SINGLE]
    twice = {agent: [seconds_of_training(agent, options.trials, SHORT, 0) for _ in range(2)] for agent in agents}
    seconds: dict[str, list[float]] = {agent: [] for agent in agents}
    for number in track(range(options.rounds), "rounds", console=Console(stderr=True)):
        turn = number % len(agents)
        for agent in agents[turn:] + agents[:turn]:
            seconds[agent].append(seconds_of_training(agent, options.trials, options.episodes, number))
    return {
        "compiling_s": {agent: round(max(first - second, 0.0), 2) for agent, (first, second) in twice.items()},
        "seconds": {agent: [round(each, 2) for each in own] for agent, own in seconds.items()},
        **{
            f"i{number}": {
                "claim": f"nested trains in fewer seconds than {other}",
                **compared(seconds[NESTED], seconds[other]),
            }
            for number, other in enumerate(agents[1:], start=1)
        },
    }, True
