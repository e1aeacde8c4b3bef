"""How much sooner several games that feed one learner reach the optimum than one game does, in simulated time.

Each game has a clock of its own, which its resets and steps advance. The game whose episode ends first is taken first,
and gets its next plan at once: practice takes no game time. What counts is the clock of the game that brings the greedy
evaluation at the optimum.

Beside other games a learner practises more thoroughly than a game alone does. With --enough 0.999 all practise alike:
then only what the games don't have to probe any more counts.
"""

import argparse
import heapq
import pickle
import statistics
import time
from dataclasses import asdict, dataclass
from typing import Any

from rich.console import Console
from rich.progress import track

from mc_nested.arena.design import KINDS, SCATTERED, kind_of_design
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.random_designs import random_scenario
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode, play_episode
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import Preset, load_preset
from scripts.bench import Figures
from sim.grid import GridGame

LIKE = "line"


@dataclass(frozen=True)
class Pace:
    """Seconds that a game takes for a reset, and for a step."""

    reset_s: float
    step_s: float


@dataclass(frozen=True)
class Reached:
    """What it took to the optimum: seconds of the slowest game, its episodes, all games' episodes.

    ``plan_bytes`` and ``episode_bytes`` are of the largest pickles, ``planning_s`` are real seconds of all plans.
    """

    seconds: float
    slowest_episodes: int
    episodes: int
    is_optimum: bool
    plan_bytes: int
    episode_bytes: int
    planning_s: float


def scattered(designs: int) -> list[Scenario]:
    """Return the first scattered designs of a benchmark of seed 0."""
    like, every = load_scenario(LIKE), range(KINDS.index(SCATTERED), designs * len(KINDS), len(KINDS))
    return [random_scenario(0, number, like) for number in every]


def until_optimum(scenario: Scenario, preset: Preset, seed: int, games: int, pace: Pace) -> Reached:
    """Train with so many games until the optimum, in simulated time."""
    spec = AGENT_SPECS["nested"]
    learner = GamesTrainer(scenario, Agent(spec, [scenario], preset, seed), preset, seed, stop_at_optimum=True)
    player = Agent(spec, [scenario], preset, seed)
    arena = ArenaVectorEnv([ArenaEnv(GridGame(scenario), scenario)])
    free, played = list(range(games)), [0] * games
    ends: list[tuple[float, int, PlayedEpisode]] = []
    plan_bytes = episode_bytes = 0
    now = planning_s = 0.0
    while not learner.finished:
        for game in free:
            began = time.perf_counter()
            plan = learner.plan(f"game {game}")
            planning_s += time.perf_counter() - began
            episode = play_episode(arena, plan, player)
            heapq.heappush(ends, (now + pace.reset_s + pace.step_s * episode.steps, game, episode))
            plan_bytes, episode_bytes = max(plan_bytes, size_of(plan)), max(episode_bytes, size_of(episode))
        now, game, episode = heapq.heappop(ends)
        learner.take(episode)
        played[game] += 1
        free = [game]
    is_optimum = learner.evaluation_rows[-1].score >= scenario.optimum
    return Reached(now, max(played), sum(played), is_optimum, plan_bytes, episode_bytes, planning_s)


def size_of(sent: EpisodePlan | PlayedEpisode) -> int:
    """Return its bytes as a pickle."""
    return len(pickle.dumps(sent))


def live(enough: float | None) -> Preset:
    """Return the preset model-based, with another share of the best imaginable that ends a practice."""
    preset = load_preset("model-based")
    if enough is None or preset.imagination is None:
        return preset
    return preset.model_copy(update={"imagination": preset.imagination.model_copy(update={"enough": enough})})


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--designs", type=int, default=12, help="scattered designs of a benchmark")
    parser.add_argument("--seeds", type=int, default=1, help="trainings on each design, of the seeds from 0 on")
    parser.add_argument("--games", default="1,3", help="numbers of games; the others are compared with the first")
    parser.add_argument("--enough", type=float, help="in place of the preset's, for a game alone")
    parser.add_argument("--reset-s", type=float, default=6.0, help="seconds of a reset")
    parser.add_argument("--step-s", type=float, default=0.34, help="seconds of a step")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Train with each number of games on a line and on scattered designs; ``ratios`` are of each kind and number."""
    pace, preset = Pace(options.reset_s, options.step_s), live(options.enough)
    first, *more = (int(part) for part in options.games.split(","))
    ratios: dict[str, list[float]] = {}
    rows: list[dict[str, Any]] = []
    jobs = [
        (each, seed) for each in [load_scenario(LIKE), *scattered(options.designs)] for seed in range(options.seeds)
    ]
    for scenario, seed in track(jobs, "trainings", console=Console(stderr=True)):
        reached = {many: until_optimum(scenario, preset, seed, many, pace) for many in (first, *more)}
        rows += [
            {"scenario": scenario.name, "seed": seed, "games": many, **asdict(each)} for many, each in reached.items()
        ]
        for many in more:
            named = f"{kind_of_design(scenario.design)}, {many} games"
            ratios.setdefault(named, []).append(reached[many].seconds / reached[first].seconds)
    wrong = sum(not row["is_optimum"] for row in rows)
    shown = {
        named: {"median": statistics.median(found), "mean": statistics.mean(found), "worst": max(found)}
        for named, found in ratios.items()
    }
    return {"wrong": wrong, "ratios": shown, "trainings": rows}, wrong == 0
