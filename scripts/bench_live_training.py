"""Measures how many minutes of game time an agent takes from scratch to the optimum, on the virtual client.

    python scripts/bench_live_training.py [--scenarios line zigzag diamond] [--seeds 5] [--first-seed 1]
        [--preset live] [--mishaps] [--json]

A trial trains until the first greedy episode at the optimum. Its game time is what passed on the client's clock from
the first reset on, resets included, and what the game waited for learning.

Nothing waits for a virtual clock, so learning is timed apart, in seconds of this computer's processor. Practice gets as
many of them as the clock says that the reset took, and a second more, as in a real game with a free core; what it takes
beyond the reset, the game waits. Within an episode it gets as many as the episode's seconds. The trainer's own work
between two episodes is waited for too; its work between two actions, below a millisecond each, isn't counted.

Every action's outcome is held against the client's world (a wrong cell, a wrong block) and against the rules
(unnoticed: the action did not happen). What the agent has learnt its game from must be exactly the episodes that
nothing spoiled. With --mishaps one happens before every hundredth action. Exit code 1 if anything was wrong, or a
median is above 4 minutes, 8 with mishaps.
"""

import argparse
import dataclasses
import json
import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
from rich.console import Console
from rich.progress import track
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game, Outcome, PlayLog
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import LiveError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.background_practice import GoesOn
from mc_nested.learn.imagination.experience import RECENT
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.live.failure_budget import FailureBudget
from mc_nested.live.profile.arena import Arena, size_for
from scripts.bench_live import MISHAP_WITHIN_S, ClientTruth, live_game
from sim.client.client import VirtualClient

MISHAP_RATE = 0.01
"""Mishaps an action, with --mishaps."""

MOST_MINUTES, MOST_MINUTES_WITH_MISHAPS = 4.0, 8.0

Transition = tuple[int, ...]
"""(x, y, b), the action, and (x, y, b) after it."""


class PracticeOnAClock:
    """A background whose work gets a second of the processor for each second on the game's clock.

    The work is done when it is ended, with as much time as has passed on that clock since it began, and the seconds
    longer. ``waited_s`` sums up what it took beyond the passed time.
    """

    def __init__(self, now: Callable[[], float], processor: Callable[[], float] = time.thread_time) -> None:
        self._now, self._processor = now, processor
        self._work: Callable[[GoesOn], None] | None = None
        self._began = 0.0
        self.processor_s = self.waited_s = 0.0
        self.cut_short = 0

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        """Take on that work."""
        self._work, self._began = work, self._now()

    def end(self, longer_s: float = 0.0) -> None:
        """Do it, for as long as it would have had."""
        if self._work is None:
            return
        passed, began = self._now() - self._began, self._processor()

        def goes_on() -> bool:
            has_time = self._processor() - began < passed + longer_s
            self.cut_short += not has_time and longer_s > 0
            return has_time

        self._work(goes_on)
        self._work = None
        took = self._processor() - began
        self.processor_s += took
        self.waited_s += max(0.0, took - passed)


class CheckedGame:
    """A live game whose every outcome is held against the client's world and the rules.

    ``episodes`` are those that nothing spoiled so far, the running one last.
    """

    resumable = None

    def __init__(self, game: Game, client: VirtualClient, arena: Arena, scenario: Scenario, rate: float) -> None:
        self._game, self._client, self._scenario, self._rate = game, client, scenario, rate
        self._truth = ClientTruth(client, arena)
        self._placed: set[Cell] = set()
        self._cell = scenario.start
        self.before_reset: Callable[[], None] = lambda: None
        self.episodes: list[list[Transition]] = []
        self.wrong_cells = self.wrong_blocks = self.unnoticed = self.actions = 0

    @property
    def log(self) -> PlayLog | None:
        """The game's."""
        return self._game.log

    def reset(self, material: int) -> Cell:
        """Begin an episode."""
        self.before_reset()
        self._cell = self._game.reset(material)
        self._placed = set()
        self._check()
        self.episodes.append([])
        return self._cell

    def act(self, action: Action, material: int | None = None) -> Outcome:
        """Act in the game, perhaps with a mishap."""
        if self._rate:
            self._client.mishaps.maybe(self._rate, MISHAP_WITHIN_S)
        self.actions += 1
        try:
            outcome = self._game.act(action, material)
        except LiveError:
            self.episodes.pop()
            raise
        before, left = self._cell, self._scenario.blocks - len(self._placed)
        cell = rules.moved(before, action, self._placed, self._scenario.size)
        block = rules.landing(cell, action, self._placed, self._scenario.size)
        self.unnoticed += (outcome.cell, outcome.placed) != (cell, block)
        self._cell = outcome.cell
        self._placed |= {outcome.placed} if outcome.placed else set()
        self._check()
        after = self._scenario.blocks - len(self._placed)
        self.episodes[-1].append((*before, left, int(action), *self._cell, after))
        return outcome

    def _check(self) -> None:
        self.wrong_cells += self._truth.cell() != self._cell
        self.wrong_blocks += not self._truth.is_built(self._placed)


@dataclasses.dataclass
class Trial:
    """One training from scratch; ``minutes`` is infinite if it never reached the optimum."""

    scenario: str
    seed: int
    solved: bool
    episodes: int
    """Real episodes that counted, the greedy ones included."""
    spoiled: int
    game_s: float
    practice_waited_s: float
    other_waited_s: float
    practice_processor_s: float
    practice_cut_short: int
    actions: int
    mishaps: int
    wrong_cells: int
    wrong_blocks: int
    unnoticed: int
    wrongly_learnt: int
    """Transitions in the learnt game's experience that aren't those of the unspoiled episodes."""

    @property
    def minutes(self) -> float:
        """Of game time to the optimum, with all that was waited for."""
        waited = self.practice_waited_s + self.other_waited_s
        return (self.game_s + waited) / 60 if self.solved else float("inf")

    @property
    def is_right(self) -> bool:
        """Whether nothing was wrong."""
        return not (self.wrong_cells or self.wrong_blocks or self.unnoticed or self.wrongly_learnt)


def train(scenario: Scenario, seed: int, preset: Preset, rate: float) -> Trial:
    """Train an agent from scratch on a new client."""
    client = VirtualClient(seed=seed)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south", size=size_for(scenario))
    background = PracticeOnAClock(client.clock.now)
    with live_game(client, scenario, arena) as live:
        game = CheckedGame(live, client, arena, scenario, rate)
        env = ArenaVectorEnv([ArenaEnv(game, scenario)])
        agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed)
        trainer = Trainer(env, [scenario], agent, preset, seed, stop_at_optimum=True, background=background)
        began, other_s, budget = client.clock.now(), 0.0, FailureBudget()
        tick_began = practised_before = 0.0

        def before_reset() -> None:
            nonlocal other_s
            if game.actions:  # what comes before the first episode, compiling included, isn't game time
                practised = background.processor_s - practised_before
                other_s += time.thread_time() - tick_began - practised

        game.before_reset = before_reset
        while not trainer.finished:
            tick_began, practised_before = time.thread_time(), background.processor_s
            try:
                trainer.tick()
            except LiveError as error:
                try:
                    budget.record_failure(error, trainer.env_steps)
                except LiveError:
                    break
                trainer.abandon_episodes()
        solved = any(row.score >= scenario.optimum for row in trainer.evaluation_rows)
        return Trial(
            scenario=scenario.name,
            seed=seed,
            solved=solved,
            episodes=len(trainer.episode_rows) + len(trainer.evaluation_rows),
            spoiled=budget.summary()["spoiled_episodes"],
            game_s=round(client.clock.now() - began, 1),
            practice_waited_s=round(background.waited_s, 1),
            other_waited_s=round(other_s, 1),
            practice_processor_s=round(background.processor_s, 1),
            practice_cut_short=background.cut_short,
            actions=game.actions,
            mishaps=len(client.mishaps.happened),
            wrong_cells=game.wrong_cells,
            wrong_blocks=game.wrong_blocks,
            unnoticed=game.unnoticed,
            wrongly_learnt=wrongly_learnt(trainer.state()["imagination.0.steps"][:, :7].tolist(), game.episodes),
        )


def wrongly_learnt(learnt: list[list[int]], episodes: list[list[Transition]]) -> int:
    """How many learnt transitions aren't those of the last RECENT episodes, in their order, or are missing."""
    expected = [list(transition) for episode in episodes[-RECENT:] for transition in episode]
    differ = sum(one != other for one, other in zip(learnt, expected, strict=False))
    return differ + abs(len(learnt) - len(expected))


def medians(trials: list[Trial]) -> dict[str, float]:
    """The median minutes of each scenario."""
    names = dict.fromkeys(trial.scenario for trial in trials)
    return {name: statistics.median(trial.minutes for trial in trials if trial.scenario == name) for name in names}


def main() -> int:
    """Parse the command line, train, print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenarios", nargs="+", default=["line", "zigzag", "diamond"])
    parser.add_argument("--seeds", type=int, default=5, help="trials of each scenario")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--preset", default="live")
    parser.add_argument("--mishaps", action="store_true", help="one before every hundredth action")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.seeds < 1:
        parser.error("--seeds must be at least 1")
    preset = load_preset(arguments.preset)
    if preset.imagination is None:
        parser.error(f"--preset must be one with a table [imagination], and {arguments.preset} has none")
    cv2.setNumThreads(1)
    rate = MISHAP_RATE if arguments.mishaps else 0.0
    jobs = [(name, arguments.first_seed + trial) for name in arguments.scenarios for trial in range(arguments.seeds)]
    trials = [
        train(load_scenario(name), seed, preset, rate)
        for name, seed in track(jobs, "trials", console=Console(stderr=True))
    ]
    most = MOST_MINUTES_WITH_MISHAPS if rate else MOST_MINUTES
    found = medians(trials)
    if arguments.json:
        rows = [{**dataclasses.asdict(trial), "minutes": trial.minutes} for trial in trials]
        print(json.dumps({"most_minutes": most, "median_minutes": found, "trials": rows}))
    else:
        _show(trials, found, most)
    return int(not (all(trial.is_right for trial in trials) and max(found.values()) <= most))


def _show(trials: list[Trial], found: dict[str, float], most: float) -> None:
    console = Console()
    for trial in trials:
        table = Table(title=f"{trial.scenario}, seed {trial.seed}: {trial.minutes:.1f} minutes", show_header=False)
        shown: dict[str, Any] = dataclasses.asdict(trial)
        for key, value in shown.items():
            if key not in ("scenario", "seed"):
                table.add_row(key, str(value))
        console.print(table)
    for name, minutes in found.items():
        console.print(f"{name}: a median of {minutes:.1f} minutes; at most {most:g} are wanted")
    console.print(
        "Practice was given the processor's seconds that the game's clock left it, and was cut short a second after a "
        "reset; what it took beyond the reset is counted as waited."
    )


if __name__ == "__main__":
    sys.exit(main())
