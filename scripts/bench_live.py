"""How exact and how fast the live path plays, on the virtual client: every action against the client's own truth.

    python scripts/bench_live.py [--actions 10000] [--rate 0.01] [--frames 20000] [--seed 0] [--json]

``clean`` plays without mishaps, ``soak`` with one before every hundredth action (lost focus, menus, death, disconnect,
lag, lost keys and so on). Actions are drawn evenly from those of the eight that the rules don't void; an episode ends
after 60 steps or when no block is left, and where an action fails: that episode is thrown away, and a reset finds the
way back. An outcome that isn't what the client's world holds is a wrong cell or a wrong block; one that is neither, of
an action that did not happen, is unnoticed. Times are the game's, from act() called to returned. ``reader`` is what
scripts/bench_reader.py measures. Exit code 1 where anything was wrong.
"""

import argparse
import dataclasses
import json
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.arena import rules
from mc_nested.arena.rules import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.action_log import percentile
from mc_nested.live.font import Font, font_of
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Arena, GameVersion
from mc_nested.live.reading import Block
from scripts import bench_reader
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas

MISHAP_WITHIN_S = 0.5
"""A mishap comes at some moment of the action before which it was drawn, or of the one after."""

SOAK_FIGURES = (
    *("actions", "mishaps", "wrong_cells", "wrong_blocks", "unnoticed", "failed_actions", "resets", "recoveries"),
    *("gave_up", "left_down", "strays", "corrections", "second_clicks"),
)
TARGETS = {"median_action_s": 0.35, "p95_action_s": 0.55}


@dataclasses.dataclass
class Play:
    """What an amount of playing came to."""

    actions: int = 0
    mishaps: int = 0
    wrong_cells: int = 0
    wrong_blocks: int = 0
    unnoticed: int = 0
    failed_actions: int = 0
    resets: int = 0
    gave_up: int = 0
    left_down: int = 0
    strays: int = 0
    corrections: int = 0
    second_clicks: int = 0
    recoveries: int = 0
    played_s: float = 0.0
    cpu_s: float = 0.0
    moves_s: list[float] = dataclasses.field(default_factory=list)
    placings_s: list[float] = dataclasses.field(default_factory=list)

    @property
    def is_right(self) -> bool:
        """Whether nothing was wrong."""
        return not (
            self.wrong_cells or self.wrong_blocks or self.unnoticed or self.gave_up or self.left_down or self.strays
        )


def play(count: int, rate: float, seed: int, scenario: Scenario) -> Play:
    """Play ``count`` actions, with a mishap before a share ``rate`` of them."""
    client = VirtualClient(seed=seed)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south")
    steps = track(range(count), "soak" if rate else "clean", console=Console(stderr=True))
    return play_in(client, live_game(client, scenario, arena), arena, scenario, steps, rate, seed)


def play_in(
    client: VirtualClient,
    game: LiveGame,
    arena: Arena,
    scenario: Scenario,
    steps: Iterable[int],
    rate: float,
    seed: int,
) -> Play:
    """Play as many actions as there are steps in that client's game, each against what the client's world holds.

    What stands there before, such as an arena's floor and border, is meant to stay as it is.
    """
    done = Play()
    laid = client.built
    rng = np.random.default_rng(seed)
    began, cpu = client.clock.now(), time.process_time()
    with game:
        placed: set[Cell] | None = None
        cell, in_episode = scenario.start, 0
        for _ in steps:
            while placed is None:
                placed, cell, in_episode = _reset(game, client, arena, laid, scenario, done, rng)
            action = drawn_action(rng, cell, placed)
            if rate:
                client.mishaps.maybe(rate, MISHAP_WITHIN_S)
            done.actions += 1
            at = client.clock.now()
            try:
                outcome = game.act(action)
            except LiveError:
                done.failed_actions += 1
                placed = None
                continue
            times = done.placings_s if action in rules.PLACES else done.moves_s
            times.append(client.clock.now() - at)
            wanted = rules.moved(cell, action, placed)
            landing = rules.landing(wanted, action, placed)
            placed |= {outcome.placed} if outcome.placed else set()
            cell = outcome.cell
            done.wrong_cells += client.cell(arena) != outcome.cell
            done.wrong_blocks += not _is_built(client, arena, laid, placed)
            done.unnoticed += (outcome.cell, outcome.placed) != (wanted, landing)
            in_episode += 1
            if len(placed) == scenario.blocks or in_episode == scenario.step_limit:
                placed = None
    done.mishaps = len(client.mishaps.happened)
    done.left_down, done.strays = len(client.window.down), len(client.window.strays)
    effort = game.log.effort
    done.corrections, done.second_clicks = effort.corrections, effort.second_clicks
    done.recoveries = game.log.recoveries
    done.played_s, done.cpu_s = client.clock.now() - began, time.process_time() - cpu
    return done


def live_game(client: VirtualClient, scenario: Scenario, arena: Arena) -> LiveGame:
    """The live path, wired to a virtual client."""
    return LiveGame(
        scenario,
        Profile(game=GameVersion(version=client.settings.version), arena=arena),
        display=client.display,
        keyboard=client.keyboard,
        pointer=client.pointer,
        clock=client.clock,
        screen=WindowScreen(client.display, _font()),
    )


def _reset(
    game: LiveGame,
    client: VirtualClient,
    arena: Arena,
    laid: dict[Block, str],
    scenario: Scenario,
    done: Play,
    rng: np.random.Generator,
) -> tuple[set[Cell] | None, Cell, int]:
    """Begin an episode: the blocks (none) and the cell, and 0 steps; None instead where that was given up."""
    try:
        cell = game.reset(int(rng.integers(len(scenario.materials))))
    except LiveError:
        done.gave_up += 1
        return None, scenario.start, 0
    done.resets += 1
    done.wrong_cells += client.cell(arena) != cell
    done.wrong_blocks += not _is_built(client, arena, laid, set())
    return set(), cell, 0


def drawn_action(rng: np.random.Generator, cell: Cell, placed: set[Cell]) -> Action:
    """One of the actions that the rules don't void."""
    return Action(int(rng.choice([int(action) for action in _possible(cell, placed)])))


def _possible(cell: Cell, placed: set[Cell]) -> Iterator[Action]:
    for action in Action:
        target = rules.moved(cell, action, placed)
        if target != cell or rules.landing(target, action, placed) is not None:
            yield action


def _is_built(client: VirtualClient, arena: Arena, laid: dict[Block, str], placed: set[Cell]) -> bool:
    """Whether these cells hold a block, and nothing else differs from what was laid before."""
    cells = {arena.block_of(cell) for cell in placed}
    built = client.built
    return cells <= built.keys() and {block: built[block] for block in built if block not in cells} == laid


def _font() -> Font:
    return font_of(drawn_atlas())


def figures(played: Play) -> dict[str, Any]:
    """How exact and how fast it was played, without mishaps."""
    every = sorted([*played.moves_s, *played.placings_s])
    counts = ("actions", "wrong_cells", "wrong_blocks", "failed_actions", "corrections", "second_clicks")
    return {
        **{name: getattr(played, name) for name in counts},
        "median_action_s": percentile(every, 50),
        "p95_action_s": percentile(every, 95),
        "moves": {"median_s": percentile(played.moves_s, 50), "p95_s": percentile(played.moves_s, 95)},
        "placings": {"median_s": percentile(played.placings_s, 50), "p95_s": percentile(played.placings_s, 95)},
    }


def report(clean: Play, soak: Play, reader: bench_reader.Result) -> dict[str, Any]:
    """What --json prints."""
    return {
        "soak": {name: getattr(soak, name) for name in SOAK_FIGURES},
        "clean": {**figures(clean), "unnoticed": clean.unnoticed},
        "reader": dataclasses.asdict(reader),
        "speed_over_real_time": round(clean.played_s / clean.cpu_s, 1),
    }


def main() -> int:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(description="How exact and how fast the live path plays on the virtual client.")
    parser.add_argument("--actions", type=int, default=10_000, help="of the clean run, and of the soak")
    parser.add_argument("--rate", type=float, default=0.01, help="mishaps an action in the soak")
    parser.add_argument("--frames", type=int, default=20_000, help="frames for the reader")
    parser.add_argument("--tesseract", type=int, default=200, help="frames for Tesseract, if it is installed")
    parser.add_argument("--scenario", default="diamond")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.actions < 1 or arguments.frames < 2:
        parser.error("--actions must be at least 1, --frames at least 2")
    cv2.setNumThreads(1)
    scenario = load_scenario(arguments.scenario)
    clean = play(arguments.actions, 0.0, arguments.seed, scenario)
    soak = play(arguments.actions, arguments.rate, arguments.seed + 1, scenario)
    reader = bench_reader.measure(_font(), arguments.frames, arguments.seed, arguments.tesseract)
    result = report(clean, soak, reader)
    if arguments.json:
        print(json.dumps(result))
    else:
        _show(result)
    fast = all(result["clean"][name] <= most for name, most in TARGETS.items())
    return int(not (clean.is_right and soak.is_right and fast and reader.wrong == 0))


def _show(result: dict[str, Any]) -> None:
    console = Console()
    for name, figures in result.items():
        if not isinstance(figures, dict):
            console.print(f"{name}: {figures}")
            continue
        table = Table(title=name, show_header=False)
        for key, value in figures.items():
            table.add_row(key, str(value))
        console.print(table)


if __name__ == "__main__":
    sys.exit(main())
