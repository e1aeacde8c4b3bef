"""Minutes of game time that an agent takes from scratch to the optimum, on the virtual client.

A trial trains until the first greedy episode at the optimum. Its game time is what passed on the client's clock from
the first reset on, resets included, and what the game waited for learning.

Nothing waits for a virtual clock, so learning is timed apart, in seconds of this computer's processor. Practice gets as
many of them as the clock says that the reset took, and a second more, as in a real game with a free core; what it takes
beyond the reset, the game waits. Within an episode it gets as many as the episode's seconds. The trainer's own work
between two episodes is waited for too; its work between two actions, below a millisecond each, isn't counted.

Every action's outcome is held against the client's world and against the rules. What the agent has learnt its game from
must be exactly the episodes that nothing spoiled. With --mishaps one happens before every hundredth action. Targets are
medians of 4 minutes, 8 with mishaps.
"""

import argparse
import dataclasses
import statistics
import time
from collections.abc import Callable

import cv2
from rich.console import Console
from rich.progress import track

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import LiveError, UserError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.imagination.background_practice import GoesOn
from mc_nested.learn.imagination.experience import RECENT
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.live.action_log import FailureBudget
from mc_nested.live.profile.arena import Arena, size_for
from scripts.bench import Figures
from scripts.benches.live import MISHAP_WITHIN_S, live_game
from scripts.benches.played import CheckedGame, ClientTruth, Transition
from sim.client.client import VirtualClient

MISHAP_RATE = 0.01
"""Mishaps an action, with --mishaps."""

MOST_MINUTES, MOST_MINUTES_WITH_MISHAPS = 4.0, 8.0


class PracticeOnAClock:
    """A background whose work gets a second of the processor for each second on the game's clock.

    The work is done all at once, when it is ended. It gets the time that has passed on that clock since it began, and
    those seconds that it is ended with. ``waited_s`` sums up what it took beyond the passed time.
    """

    def __init__(self, now: Callable[[], float], processor: Callable[[], float] = time.thread_time) -> None:
        self._now, self._processor = now, processor
        self._work: Callable[[GoesOn], None] | None = None
        self._began = 0.0
        self.processor_s = self.waited_s = 0.0
        self.cut_short = 0

    def begin(self, work: Callable[[GoesOn], None]) -> None:
        """Take on that work, which ``end`` does."""
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


@dataclasses.dataclass
class TimedTraining:
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


def train(scenario: Scenario, seed: int, preset: Preset, rate: float) -> TimedTraining:
    """Train an agent from scratch on a new client."""
    client = VirtualClient(seed=seed)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south", size=size_for(scenario))
    background = PracticeOnAClock(client.clock.now)
    with live_game(client, scenario, arena) as live:
        game = CheckedGame(live, ClientTruth(client, arena), scenario, client.clock.now)
        counts = game.counts
        env = ArenaVectorEnv([ArenaEnv(game, scenario)])
        agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed)
        trainer = Trainer(env, [scenario], agent, preset, seed, stop_at_optimum=True, background=background)
        began, other_s, budget = client.clock.now(), 0.0, FailureBudget()
        tick_began = practised_before = 0.0

        def before_reset() -> None:
            nonlocal other_s
            if counts.actions:  # what comes before the first episode, compiling included, isn't game time
                practised = background.processor_s - practised_before
                other_s += time.thread_time() - tick_began - practised

        def before_act(_action: int) -> None:
            if rate:
                client.mishaps.maybe(rate, MISHAP_WITHIN_S)

        game.before_reset, game.before_act = before_reset, before_act
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
        return TimedTraining(
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
            actions=counts.actions,
            mishaps=len(client.mishaps.happened),
            wrong_cells=counts.wrong_cells,
            wrong_blocks=counts.wrong_blocks,
            unnoticed=counts.unnoticed,
            wrongly_learnt=wrongly_learnt(trainer.state()["practice.0.steps"][:, :7].tolist(), game.episodes),
        )


def wrongly_learnt(learnt: list[list[int]], episodes: list[list[Transition]]) -> int:
    """Count the learnt transitions that aren't those of the last RECENT episodes, in their order, or are missing."""
    expected = [list(transition) for episode in episodes[-RECENT:] for transition in episode]
    differ = sum(one != other for one, other in zip(learnt, expected, strict=False))
    return differ + abs(len(learnt) - len(expected))


def medians(trials: list[TimedTraining]) -> dict[str, float]:
    """Return the median minutes of each scenario."""
    names = dict.fromkeys(trial.scenario for trial in trials)
    return {name: statistics.median(trial.minutes for trial in trials if trial.scenario == name) for name in names}


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--scenarios", nargs="+", default=["line", "zigzag", "diamond"])
    parser.add_argument("--seeds", type=int, default=5, help="trials of each scenario")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--preset", default="model-based")
    parser.add_argument("--mishaps", action="store_true", help="one before every hundredth action")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Train every trial."""
    if options.seeds < 1:
        raise UserError("--seeds must be at least 1")
    preset = load_preset(options.preset)
    if preset.imagination is None:
        raise UserError(f"--preset must be one with a table [imagination], and {options.preset} has none")
    cv2.setNumThreads(1)
    rate = MISHAP_RATE if options.mishaps else 0.0
    jobs = [(name, options.first_seed + trial) for name in options.scenarios for trial in range(options.seeds)]
    trials = [
        train(load_scenario(name), seed, preset, rate)
        for name, seed in track(jobs, "trials", console=Console(stderr=True))
    ]
    most, found = MOST_MINUTES_WITH_MISHAPS if rate else MOST_MINUTES, medians(trials)
    rows = [{**dataclasses.asdict(trial), "minutes": trial.minutes} for trial in trials]
    is_right = all(trial.is_right for trial in trials) and max(found.values()) <= most
    return {"most_minutes": most, "median_minutes": found, "trials": rows}, is_right
