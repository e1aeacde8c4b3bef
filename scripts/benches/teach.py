"""Episodes that an agent plays to the optimum, with a person's build to learn from and without.

For each seed a clumsy person takes over on the virtual client, from the first step on, and builds the design by hand:
one move in five is needless, two blocks are wrong. The recording of that is given to a training in the simulator
(train --from-recording), which is held against the same training without it. The episodes that the agent then plays
itself count, the greedy ones included. The target: at most half as many, by the medians.
"""

import argparse
import dataclasses
import statistics
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import tomlkit
from rich.progress import track

from mc_nested.arena.action import Action
from mc_nested.arena.demonstration import Demonstration
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, table_of
from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.whole_episode import as_seen
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena, size_for
from mc_nested.live.profile.tables import GameVersion, Profile
from mc_nested.live.recording.demonstrations import demonstrations_in
from mc_nested.live.recording.run_recorder import open_recorder
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.game_screen import WindowScreen
from scripts.bench import Figures
from scripts.benches.person import Hands, clumsy
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.grid import GridVectorEnv

NEEDLESS, WRONG = 0.2, 2
"""How clumsy the person is: the share of needless moves, and the wrong blocks."""


@dataclasses.dataclass(frozen=True)
class Taught:
    """Episodes that one seed's agent plays to the optimum; infinite if it never comes there."""

    seed: int
    shown_steps: int
    with_it: float
    without: float


def record_a_build(folder: Path, scenario: Scenario, by_hand: Sequence[Action], seed: int) -> None:
    """Record how a person who has taken over does these actions in an episode, until it is over."""
    client = VirtualClient(seed=seed)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south", size=size_for(scenario))
    version = client.settings.version
    profile = Profile(game=GameVersion(version=version), arena=arena)
    facts = {"scenario": tomlkit.dumps(table_of(scenario).model_dump(exclude_none=True))}
    with open_recorder(folder, "teach", print, profile, client.devices, facts) as recorder:
        if recorder is None:
            raise UserError(f"{folder}: nothing could be recorded: make room")
        devices = recorder.devices(client.devices)
        controller = InputController(devices, profile.input, recorder.hands)
        screen = WindowScreen(devices.display, font_of(drawn_atlas()), version=version)
        connection = GameConnection(devices, controller, screen, journal=recorder, on_screen=recorder.screen)
        with LiveGame(scenario, profile, connection) as game:
            env, hands, is_over = ArenaEnv(game, scenario), Hands(client, arena), False
            env.reset()
            controller.switch_over()
            hands.play(hands.do(by_hand))
            while not is_over:
                _, _, terminated, truncated, info = env.step(Action.F)
                if "instead" not in info:
                    raise RuntimeError("the agent acted, although a person had taken over")
                is_over = terminated or truncated


def played_to_optimum(scenario: Scenario, preset: Preset, seed: int, shown: Sequence[Demonstration]) -> float:
    """Return the episodes that a training plays to the optimum, greedy ones included, after those that it was shown."""
    agent = Agent(AGENT_SPECS["nested"], [scenario], preset, seed)
    trainer = Trainer(GridVectorEnv([scenario]), [scenario], agent, preset, seed, stop_at_optimum=True)
    for each in shown:
        trainer.learn_from(as_seen(agent, scenario, each))
    while not trainer.finished:
        trainer.tick()
    if trainer.policy_scores[0] < scenario.optimum:
        return float("inf")
    return float(len(trainer.episode_rows) - len(shown) + len(trainer.evaluation_rows))


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--seeds", type=int, default=20, help="from 0 on; each has a build, and two trainings")
    parser.add_argument("--scenario", default="diamond", help="what is built")
    parser.add_argument("--preset", default="model-based", help="hyper-parameters")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Return the episodes with and without a build to learn from, and whether the target is met."""
    if options.seeds < 1:
        raise UserError("--seeds: 1 or more")
    scenario, preset = load_scenario(options.scenario), load_preset(options.preset)
    taught = []
    with TemporaryDirectory() as folder:
        for seed in track(range(options.seeds), "teaching"):
            recording = Path(folder) / str(seed)
            record_a_build(recording, scenario, clumsy(scenario, seed, NEEDLESS, WRONG), seed)
            shown, _ = demonstrations_in(recording, scenario)
            episodes = [played_to_optimum(scenario, preset, seed, each) for each in (shown, [])]
            taught.append(Taught(seed, len(shown[0].steps), *episodes))
    with_it, without = ([getattr(each, name) for each in taught] for name in ("with_it", "without"))
    figures = {
        "episodes to the optimum after a build by hand": _spread(with_it),
        "episodes to the optimum without": _spread(without),
        "ratio of the medians": statistics.median(with_it) / statistics.median(without),
        "seeds": [dataclasses.asdict(each) for each in taught],
    }
    return figures, figures["ratio of the medians"] <= 0.5


def _spread(episodes: Sequence[float]) -> dict[str, float]:
    return {"median": statistics.median(episodes), "fewest": min(episodes), "most": max(episodes)}
