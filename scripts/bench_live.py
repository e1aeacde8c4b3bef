"""Measures how exactly and how fast the live path plays on the virtual client, whose world checks every action.

    python scripts/bench_live.py [--actions 10000] [--rate 0.01] [--frames 20000] [--seed 0] [--json]
        [--latency-ms 60 90] [--version 26.3]

``clean`` plays without mishaps, ``soak`` with one before every hundredth action (lost focus, menus, death, disconnect,
lag, lost keys and so on); five each of those that open a screen are planned, the others drawn. Actions are drawn
uniformly from those that the rules don't void. An episode ends after 60 steps, when no block is left, when the agent is
walled in, or when an action fails: then it is thrown away, and the reset recovers; three resets in a row that fail are
the end. An outcome that differs from the client's world is a wrong cell or a wrong block. An outcome that matches the
world but not the rules is unnoticed: the action did not happen.
``into_screens`` are presses for the world that reached a screen over it, though a picture of that screen was to be had;
``too_late`` those where none was. Times are the game's, for one call of act(). ``cpu_ms_per_action`` is the processor's
time for an action of the clean run, resets included: client, drawing, reading and body. ``reader`` is what
scripts/bench_reader.py measures. Exit code 1 if anything was wrong.

With --latency-ms pictures are so old, from and to, and the walk is calibrated first: latencies are the profile's, as
after `mc-nested calibrate walk`. How fast it then plays is printed, and not judged.
"""

import argparse
import dataclasses
import json
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Protocol

import cv2
import numpy as np
from rich.console import Console
from rich.progress import track
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from calibration.context import CalibrationContext
from calibration.walk.measure import walk
from mc_nested.arena import rules
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError
from mc_nested.live.action_log import percentile
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena, size_for
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile, ScreenTable, WalkTable
from mc_nested.live.vision.font import Font, font_of
from mc_nested.live.vision.game_screen import WindowScreen
from scripts import bench_reader
from scripts.into_screens import ScreenPresses
from sim.client.client import VirtualClient
from sim.client.drawing.font import drawn_atlas
from sim.client.mishaps import Kind
from sim.client.settings import ClientSettings

MISHAP_WITHIN_S = 0.5
"""A mishap happens at a random moment within this time after it is drawn: in that action or in the next one."""

VERSION = "1.20.1"
"""The game's, if no other is asked for."""

OPEN_SCREENS: tuple[Kind, ...] = ("lost_focus", "pause", "death", "inventory", "chat", "disconnect")
"""The mishaps after which a screen lies over the world; a game without the focus pauses."""

GIVES_UP = 3
"""Resets in a row that may fail: a game that can't be reset would go on for ever."""

PLANNED = 5
"""How often each of them is planned in a soak."""

SOAK_FIGURES = (
    *("actions", "mishaps", "wrong_cells", "wrong_blocks", "unnoticed", "failed_actions", "resets", "recoveries"),
    *("gave_up", "left_down", "strays", "into_screens", "too_late", "corrections", "second_clicks"),
)
GROUND_PITCH = 65.0
"""Degrees down at which the ground is looked at: a screen that names a block is read ten times as fast."""

LONGEST_LATENCY_MS = 350
"""The longest that the walk's calibration finds, with the way of a press beside it."""

TARGETS = {"median_action_s": 0.35, "p95_action_s": 0.55}


@dataclasses.dataclass
class PlayCounts:
    """What was played, what went wrong, and how long it took."""

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
    into_screens: int = 0
    too_late: int = 0
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
        wrong = (self.wrong_cells, self.wrong_blocks, self.unnoticed, self.gave_up, self.left_down)
        return not any((*wrong, self.strays, self.into_screens))


def play(
    count: int,
    rate: float,
    seed: int,
    scenario: Scenario,
    latency_ms: tuple[float, float] | None = None,
    version: str = VERSION,
) -> PlayCounts:
    """Play ``count`` actions on a new client, with a mishap before a share ``rate`` of them.

    With ``latency_ms`` its pictures are so old, from and to, and the walk is calibrated before.
    """
    settings = ClientSettings(seed=seed, version=version)
    if latency_ms is not None:
        latency_s = (latency_ms[0] / 1000, latency_ms[1] / 1000)
        settings = dataclasses.replace(settings, pitch=GROUND_PITCH, capture_latency_s=latency_s)
    client = VirtualClient(settings)
    walk_table = calibrated_walk(client) if latency_ms else None
    arena = Arena.around((-20, client.realm.world.floor, 31), "south", size=size_for(scenario))
    steps = track(range(count), "soak" if rate else "clean", console=Console(stderr=True))
    presses = ScreenPresses(client)
    game = live_game(client, scenario, arena, walk_table, presses.controller())
    planned = planned_mishaps(count, np.random.default_rng(seed)) if rate else {}
    counts = play_in(client, game, arena, scenario, steps, rate, seed, planned)
    counts.into_screens, counts.too_late = presses.into_screens, presses.too_late
    return counts


def planned_mishaps(count: int, rng: np.random.Generator) -> dict[int, Kind]:
    """Before which of so many actions a mishap that opens a screen comes: each kind PLANNED times, if they fit."""
    kinds = [kind for kind in OPEN_SCREENS for _ in range(PLANNED)]
    at = rng.permutation(count)[: len(kinds)]
    return {int(step): kind for step, kind in zip(at, kinds, strict=False)}


def calibrated_walk(client: VirtualClient) -> WalkTable:
    """The walk of a client's player and its latencies, as `calibrate walk` measures them around where it stands."""
    with tempfile.TemporaryDirectory() as folder:
        font = Path(folder) / "ascii.png"
        font.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
        profile = Profile(game=GameVersion(version=client.settings.version), screen=ScreenTable(font=str(font)))
        with connection_to(client) as connection:
            return walk(CalibrationContext(connection, lambda _: None, lambda _: True), profile).profile.walk


class WorldTruth(Protocol):
    """What the game's world really holds, known without its screen."""

    def cell(self) -> Cell:
        """The cell that the player stands on."""

    def is_built(self, placed: set[Cell]) -> bool:
        """Whether these cells hold a block, and nothing else was built."""


class ClientTruth:
    """What the client's world really holds. What was built before, such as a floor and a border, must stay."""

    def __init__(self, client: VirtualClient, arena: Arena) -> None:
        self._client, self._arena = client, arena
        self._built_before = client.built

    def cell(self) -> Cell:
        """The cell that the player stands on."""
        return self._client.cell(self._arena)

    def is_built(self, placed: set[Cell]) -> bool:
        """Whether these cells hold a block, and everything else is as before."""
        cells = {self._arena.block_of(cell) for cell in placed}
        built = self._client.built
        others = {block: built[block] for block in built if block not in cells}
        return cells <= built.keys() and others == self._built_before


def play_in(
    client: VirtualClient,
    game: LiveGame,
    arena: Arena,
    scenario: Scenario,
    steps: Iterable[int],
    rate: float,
    seed: int,
    planned: Mapping[int, Kind] = MappingProxyType({}),
) -> PlayCounts:
    """Play as many actions as there are steps in that client's game, each checked against the client's world."""
    counts = PlayCounts()
    truth = ClientTruth(client, arena)
    rng = np.random.default_rng(seed)
    began, cpu = client.clock.now(), time.process_time()
    with game:
        placed: set[Cell] | None = None
        cell, in_episode = scenario.start, 0
        for _ in steps:
            gave_up = counts.gave_up
            while placed is None:
                placed, cell, in_episode = _reset(game, truth, scenario, counts, rng)
                if placed is None and counts.gave_up - gave_up == GIVES_UP:
                    raise LiveError(f"{GIVES_UP} resets in a row failed")
            action = drawn_action(rng, cell, placed, scenario.size)
            if (kind := planned.get(counts.actions)) is not None:
                client.mishaps.plan(kind, float(rng.uniform(0, MISHAP_WITHIN_S)))
            elif rate:
                client.mishaps.maybe(rate, MISHAP_WITHIN_S)
            counts.actions += 1
            act_began = client.clock.now()
            try:
                outcome = game.act(action)
            except LiveError:
                counts.failed_actions += 1
                placed = None
                continue
            times = counts.placings_s if action in rules.PLACES else counts.moves_s
            times.append(client.clock.now() - act_began)
            expected_cell = rules.moved(cell, action, placed, scenario.size)
            expected_block = rules.landing(expected_cell, action, placed, scenario.size)
            placed |= {outcome.placed} if outcome.placed else set()
            cell = outcome.cell
            counts.wrong_cells += truth.cell() != outcome.cell
            counts.wrong_blocks += not truth.is_built(placed)
            counts.unnoticed += (outcome.cell, outcome.placed) != (expected_cell, expected_block)
            in_episode += 1
            if is_over(cell, placed, in_episode, scenario):
                placed = None
    counts.mishaps = len(client.mishaps.happened)
    counts.left_down, counts.strays = len(client.window.down), len(client.window.strays)
    effort = game.log.effort
    counts.corrections, counts.second_clicks = effort.corrections, effort.second_clicks
    counts.recoveries = game.log.recoveries
    counts.played_s, counts.cpu_s = client.clock.now() - began, time.process_time() - cpu
    return counts


def live_game(
    client: VirtualClient,
    scenario: Scenario,
    arena: Arena,
    walk_table: WalkTable | None = None,
    controller: InputController | None = None,
) -> LiveGame:
    """A live game on a virtual client, whose player walks like that, or as usual; pressed by that controller."""
    return LiveGame(
        scenario,
        Profile(game=GameVersion(version=client.settings.version), arena=arena, walk=walk_table or WalkTable()),
        connection_to(client, controller),
    )


def connection_to(client: VirtualClient, controller: InputController | None = None) -> GameConnection:
    """A connection to a virtual client, read with its own font."""
    screen = WindowScreen(client.display, _font(), version=client.settings.version)
    return GameConnection(client.devices, controller or InputController(client.devices, InputTable()), screen)


def _reset(
    game: LiveGame, truth: WorldTruth, scenario: Scenario, counts: PlayCounts, rng: np.random.Generator
) -> tuple[set[Cell] | None, Cell, int]:
    """Begin an episode: no blocks yet, the start cell, 0 steps. None instead of the blocks if the game gave up."""
    try:
        cell = game.reset(int(rng.integers(len(scenario.materials))))
    except LiveError:
        counts.gave_up += 1
        return None, scenario.start, 0
    counts.resets += 1
    counts.wrong_cells += truth.cell() != cell
    counts.wrong_blocks += not truth.is_built(set())
    return set(), cell, 0


def is_over(cell: Cell, placed: set[Cell], steps: int, scenario: Scenario) -> bool:
    """Whether an episode ends here: no block is left, or no step, or the agent has walled itself in."""
    is_out = len(placed) == scenario.blocks or steps == scenario.step_limit
    return is_out or next(_possible(cell, placed, scenario.size), None) is None


def drawn_action(rng: np.random.Generator, cell: Cell, placed: set[Cell], size: int) -> Action:
    """A random action among those that the rules don't void."""
    return Action(int(rng.choice([int(action) for action in _possible(cell, placed, size)])))


def _possible(cell: Cell, placed: set[Cell], size: int) -> Iterator[Action]:
    for action in Action:
        target = rules.moved(cell, action, placed, size)
        if target != cell or rules.landing(target, action, placed, size) is not None:
            yield action


@cache
def _font() -> Font:
    return font_of(drawn_atlas())


def figures(played: PlayCounts) -> dict[str, Any]:
    """The counts and times of playing without mishaps."""
    every = sorted([*played.moves_s, *played.placings_s])
    counts = ("actions", "wrong_cells", "wrong_blocks", "failed_actions", "corrections", "second_clicks")
    return {
        **{name: getattr(played, name) for name in counts},
        "median_action_s": percentile(every, 50),
        "p95_action_s": percentile(every, 95),
        "moves": {"median_s": percentile(played.moves_s, 50), "p95_s": percentile(played.moves_s, 95)},
        "placings": {"median_s": percentile(played.placings_s, 50), "p95_s": percentile(played.placings_s, 95)},
    }


def report(clean: PlayCounts, soak: PlayCounts, reader: bench_reader.Result) -> dict[str, Any]:
    """What --json prints."""
    return {
        "soak": {name: getattr(soak, name) for name in SOAK_FIGURES},
        "clean": {**figures(clean), "unnoticed": clean.unnoticed},
        "reader": dataclasses.asdict(reader),
        "speed_over_real_time": round(clean.played_s / clean.cpu_s, 1),
        "cpu_ms_per_action": round(1000 * clean.cpu_s / clean.actions, 3),
    }


def main() -> int:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(description="How exactly and how fast the live path plays on the virtual client.")
    parser.add_argument("--actions", type=int, default=10_000, help="of the clean run, and of the soak")
    parser.add_argument("--rate", type=float, default=0.01, help="mishaps an action in the soak")
    parser.add_argument("--frames", type=int, default=20_000, help="frames for the reader")
    parser.add_argument("--tesseract", type=int, default=200, help="frames for Tesseract, if it is installed")
    parser.add_argument(
        "--latency-ms", type=float, nargs=2, metavar=("LEAST", "MOST"), help="the age of a picture; calibrates the walk"
    )
    parser.add_argument("--version", default=VERSION, help="the game's")
    parser.add_argument("--scenario", default="diamond")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.actions < 1 or arguments.frames < 2:
        parser.error("--actions must be at least 1, --frames at least 2")
    latency_ms = tuple(arguments.latency_ms) if arguments.latency_ms else None
    if latency_ms and not 0 <= latency_ms[0] <= latency_ms[1] <= LONGEST_LATENCY_MS:
        parser.error(f"--latency-ms must be two times from 0 to {LONGEST_LATENCY_MS}, the shorter one first")
    cv2.setNumThreads(1)
    scenario = load_scenario(arguments.scenario)
    clean = play(arguments.actions, 0.0, arguments.seed, scenario, latency_ms, arguments.version)
    soak = play(arguments.actions, arguments.rate, arguments.seed + 1, scenario, latency_ms, arguments.version)
    reader = bench_reader.measure(_font(), arguments.frames, arguments.seed, arguments.tesseract)
    result = report(clean, soak, reader)
    if arguments.json:
        print(json.dumps(result))
    else:
        _show(result)
    fast = latency_ms is not None or all(result["clean"][name] <= most for name, most in TARGETS.items())
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
