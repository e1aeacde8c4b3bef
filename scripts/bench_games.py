"""How much sooner several games that feed one learner reach the optimum than one game does, in simulated time.

Each game has a clock of its own, which its resets and steps advance. The game whose episode ends first is taken first,
and gets its next plan at once: practice takes no game time. What counts is the clock of the game that brings the greedy
evaluation at the optimum.

    python scripts/bench_games.py [--designs 12] [--seeds 3] [--json]

Beside other games a learner practises more thoroughly than a game alone does with the preset live. With --enough 0.999
all practise alike: then only what the games don't have to probe any more counts.
"""

import argparse
import heapq
import json
import pickle
import statistics
import sys
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena.design_kind import KINDS, SCATTERED, kind_of_design
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.random_designs import random_scenario
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.games.player import play_episode
from mc_nested.learn.preset import Preset, load_preset
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

    def in_words(self) -> str:
        """Everything, in a line."""
        return (
            f"{self.seconds:6.0f} s, {self.slowest_episodes:3} episodes of the slowest, {self.episodes:3} of all, "
            f"{'optimum' if self.is_optimum else 'NO OPTIMUM'}, planned in {self.planning_s:.0f} s, "
            f"plan {self.plan_bytes:,} bytes, episode {self.episode_bytes:,} bytes"
        )


def scattered(designs: int) -> list[Scenario]:
    """The first scattered designs of a benchmark of seed 0."""
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
    """Its bytes as a pickle."""
    return len(pickle.dumps(sent))


def live(enough: float | None) -> Preset:
    """The preset live, with another share of the best imaginable that ends a practice."""
    preset = load_preset("live")
    if enough is None or preset.imagination is None:
        return preset
    return preset.model_copy(update={"imagination": preset.imagination.model_copy(update={"enough": enough})})


def main() -> None:
    """Compare numbers of games on scattered designs, and show what they do on a line."""
    parser = argparse.ArgumentParser(description="Several games that feed one learner, in simulated time")
    parser.add_argument("--designs", type=int, default=12, help="scattered designs of a benchmark [12]")
    parser.add_argument("--seeds", type=int, default=1, help="trainings on each design, of the seeds from 0 on [1]")
    parser.add_argument("--games", default="1,3", help="numbers of games; the others are compared with the first [1,3]")
    parser.add_argument("--enough", type=float, help="in place of the preset's, for a game alone")
    parser.add_argument("--reset-s", type=float, default=6.0, help="seconds of a reset [6]")
    parser.add_argument("--step-s", type=float, default=0.34, help="seconds of a step [0.34]")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON, too")
    options = parser.parse_args()
    pace, preset = Pace(options.reset_s, options.step_s), live(options.enough)
    first, *more = (int(part) for part in options.games.split(","))
    ratios: dict[tuple[str, int], list[float]] = {}
    rows: list[dict[str, Any]] = []
    for scenario in [load_scenario(LIKE), *scattered(options.designs)]:
        for seed in range(options.seeds):
            of_first = until_optimum(scenario, preset, seed, first, pace)
            print(f"{scenario.name:14} seed {seed}, games: {first}, {of_first.in_words()}", flush=True)
            rows.append({"scenario": scenario.name, "seed": seed, "games": first, **asdict(of_first)})
            for many in more:
                reached = until_optimum(scenario, preset, seed, many, pace)
                rows.append({"scenario": scenario.name, "seed": seed, "games": many, **asdict(reached)})
                ratio = reached.seconds / of_first.seconds
                ratios.setdefault((kind_of_design(scenario.design), many), []).append(ratio)
                print(f"{'':14} seed {seed}, games: {many}, {reached.in_words()}, ratio {ratio:.2f}", flush=True)
    for (kind, many), found in ratios.items():
        print(
            f"{kind}, games: {many}, {len(found)} trainings: median ratio {statistics.median(found):.2f}, "
            f"mean {statistics.mean(found):.2f}, worst {max(found):.2f}"
        )
    if options.json:
        print(json.dumps({"wrong": sum(not row["is_optimum"] for row in rows), "trainings": rows}))


if __name__ == "__main__":
    main()
