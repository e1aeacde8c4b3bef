"""How much sooner three served games that feed one learner reach the optimum than one game alone, on virtual clients.

    python scripts/bench_served_games.py [--designs 12] [--seeds 1] [--games 3] [--one-served]

Scheduler, games and learner are processes of their own, begun anew for each training; the learner begins once all
games have joined. One game alone is `mc-nested train --backend virtual`: there practice is cut short a second of real
time after a reset, so a busy computer makes it slower. With --one-served they are compared with a single served game,
too, whose learner practises to the end.

The time is that of the virtual clients' clocks, from the opening of the game on: its resets and its actions. A game's
clock is read at the end of its last episode that came back; the slowest game's counts. A clock stands still while its
game waits for its learner, which practises. Which game is asked first depends on real time, so a seed gives other
episodes each time. Exit code 1 if a training missed its optimum, or the median ratio of the scattered designs is above
a half. Needs the extra `cluster`.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena.design_kind import SCATTERED
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, table_of
from scripts.bench_games import LIKE, scattered
from scripts.dask_programs import scheduler
from scripts.served_games import ROOT, ServedGame, command

MOST_RATIO = 0.5
"""The largest median of the scattered designs that is wanted."""

TRAINING_S = 600.0
"""Real seconds that a training may take."""


@dataclass(frozen=True)
class TrainingTime:
    """What a training took: seconds on each game's clock, episodes of all games; whether it reached the optimum."""

    clocks: tuple[float, ...]
    episodes: int
    lost: int
    is_optimum: bool

    @property
    def seconds(self) -> float:
        """On the slowest game's clock."""
        return max(self.clocks)

    def in_words(self) -> str:
        """Everything, in a few words."""
        clocks = f" ({', '.join(f'{each:.0f}' for each in self.clocks)})" if len(self.clocks) > 1 else ""
        lost = f", {self.lost} lost" if self.lost else ""
        return (
            f"{self.seconds:.0f} s{clocks}, {self.episodes} episodes{lost}{'' if self.is_optimum else ', NO OPTIMUM'}"
        )


def trained_in(out: Path) -> TrainingTime:
    """What the training in that folder took. Every episode that came back is in one of its two tables."""
    summary: Mapping[str, Any] = json.loads((out / "summary.json").read_text("utf-8"))
    tables = [(out / name).read_text("utf-8").splitlines()[1:] for name in ("episodes.csv", "evaluations.csv")]
    live, (score,) = summary["live"], summary["final_scores"]
    is_optimum = score is not None and score >= summary["optimum"]
    return TrainingTime(tuple(live["game_s"]), sum(map(len, tables)), live["spoiled_episodes"], is_optimum)


def train(scenario: Scenario, seed: int, games: int = 0) -> TrainingTime:
    """Train with so many served games, begun for it alone; with none, in the learner's own game.

    RuntimeError, TimeoutError or TimeoutExpired if it can't be done.
    """
    with tempfile.TemporaryDirectory() as temporary, ExitStack() as stack:
        folder = Path(temporary)
        design, out = folder / "design.toml", folder / "run"
        design.write_text(tomlkit.dumps(table_of(scenario).model_dump(exclude_none=True)), "utf-8")
        words = ["train", "--backend", "virtual", "--preset", "live", "--stop-at-optimum", "--quiet"]
        words += ["--scenario", str(design), "--seed", str(seed), "--out", str(out)]
        if games:
            words += ["--games", stack.enter_context(served(folder, games))]
        done = subprocess.run(  # noqa: S603 - our own
            command(*words), cwd=ROOT, capture_output=True, text=True, check=False, timeout=TRAINING_S
        )
        if done.returncode:
            raise RuntimeError(f"the training of {scenario.name} ended with {done.returncode}: {done.stderr[-400:]}")
        trained = trained_in(out)
        if len(trained.clocks) != max(games, 1):
            raise RuntimeError(f"of {games} games, {len(trained.clocks)} have played {scenario.name}")
        return trained


@contextmanager
def served(folder: Path, games: int) -> Iterator[str]:
    """A scheduler that so many games have joined: its address. They are ended after the block."""
    with scheduler(folder) as url, ExitStack() as stack:
        joining = []
        for number in range(1, games + 1):
            joining.append(ServedGame(f"game-{number}", url, folder))
            stack.callback(joining[-1].end)
        for game in joining:
            game.wait_until_joined()
        yield url


def in_sum(ratios: Sequence[float]) -> str:
    """Their median, mean and worst."""
    found = f"median ratio {statistics.median(ratios):.2f}, mean {statistics.mean(ratios):.2f}"
    return f"{len(ratios)} trainings: {found}, worst {max(ratios):.2f}"


def main() -> int:
    """Compare served games with one game alone on the line and on scattered designs; 1 as the script's text says."""
    parser = argparse.ArgumentParser(description="Served games that feed one learner, by the virtual clients' clocks")
    parser.add_argument("--designs", type=int, default=12, help="scattered designs of a benchmark [12]")
    parser.add_argument("--seeds", type=int, default=1, help="trainings on each design, of the seeds from 0 on [1]")
    parser.add_argument("--games", type=int, default=3, help="that are served, compared with one game alone [3]")
    parser.add_argument("--one-served", action="store_true", help="compare them with one served game, too")
    options = parser.parse_args()
    if min(options.designs, options.seeds, options.games) < 1:
        parser.error("--designs, --seeds and --games must be at least 1")
    ratios: dict[tuple[str, str], list[float]] = {}
    have_all_reached = True
    for scenario in [load_scenario(LIKE), *scattered(options.designs)]:
        kind = LIKE if scenario.name == LIKE else SCATTERED
        for seed in range(options.seeds):
            fewer = {"alone": train(scenario, seed)}
            several = train(scenario, seed, options.games)
            if options.one_served:
                fewer["one served"] = train(scenario, seed, 1)
            have_all_reached &= all(each.is_optimum for each in (several, *fewer.values()))
            said = f"{scenario.name}, seed {seed}: {options.games} served: {several.in_words()}"
            for name, one in fewer.items():
                ratio = several.seconds / one.seconds
                ratios.setdefault((kind, name), []).append(ratio)
                said += f"; {name}: {one.in_words()}, ratio {ratio:.2f}"
            print(said, flush=True)
    for (kind, name), found in ratios.items():
        print(f"{kind}, {options.games} served against {name}, {in_sum(found)}")
    return 0 if have_all_reached and statistics.median(ratios[SCATTERED, "alone"]) <= MOST_RATIO else 1


if __name__ == "__main__":
    sys.exit(main())
