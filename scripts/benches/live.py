"""How exactly and how fast the live path plays on the virtual client, whose world checks every action.

``clean`` plays without mishaps, ``soak`` with one before every hundredth action (lost focus, menus, death, disconnect,
lag, lost keys and so on); five each of those that open a screen are planned, the others drawn. Actions are drawn
uniformly from those that the rules don't void. An episode ends after 60 steps, when no block is left, when the agent is
walled in, or when an action fails: then it is thrown away, and the reset recovers; three resets in a row that fail are
the end. ``into_screens`` are presses for the world that reached a screen over it, though a picture of that screen was
to be had; ``too_late`` those where none was. Times are the game's, for one call of act(). ``cpu_ms_per_action`` is the
processor's time for an action of the clean run, resets included: client, drawing, reading and body. ``reader`` is what
`bench.py reader` measures.

Each action is told the next one, which is drawn for where the rules say that it leads, and begins its walk meanwhile;
with --no-overlap each waits for the end of the one before. ``designs`` are built by the scripted builder, both ways by
turns: the seconds an action, and ``straight_s``, the seconds a cell where it builds on in one direction.

With --latency-ms pictures are so old, from and to, and the walk is calibrated first: latencies are the profile's, as
after `mc-nested calibrate walk`. How fast it then plays is printed, and not judged.
"""

import argparse
import dataclasses
import statistics
import tempfile
import time
from collections.abc import Callable, Iterable
from functools import cache
from itertools import groupby, pairwise
from pathlib import Path

import cv2
import numpy as np
from rich.console import Console
from rich.progress import track

from calibration.context import CalibrationContext
from calibration.walk.measure import walk
from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import UserError
from mc_nested.live.action_log import percentile
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena, size_for
from mc_nested.live.profile.tables import GameVersion, InputTable, Profile, ScreenTable, WalkTable
from mc_nested.live.vision.font import Font, font_of
from mc_nested.live.vision.game_screen import WindowScreen
from scripts.bench import Figures
from scripts.benches import reader
from scripts.benches.into_screens import ScreenPresses
from scripts.benches.played import ClientTruth, PlayCounts, figures_of, play_in
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.mishaps import Kind
from sim.client.settings import ClientSettings

MISHAP_WITHIN_S = 0.5
"""A mishap happens at a random moment within this time after it is drawn: in that action or in the next one."""

VERSION = "1.20.1"
"""The version of the game, if no other is asked for."""

OPEN_SCREENS: tuple[Kind, ...] = ("lost_focus", "pause", "death", "inventory", "chat", "disconnect")
"""The mishaps after which a screen lies over the world; a game without the focus pauses."""

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

TARGETS = {
    True: {"median_action_s": 0.27, "p95_action_s": 0.36},
    False: {"median_action_s": 0.35, "p95_action_s": 0.55},
}
"""The most seconds of an action, where actions overlap and where they don't."""

DESIGNS, BUILDS, LEAST_STRAIGHT = ("line", "zigzag", "diamond"), 20, 5
"""What is built, how often, and the cells in one direction from which on their time counts as that of a straight run.
"""


def play(
    count: int,
    rate: float,
    seed: int,
    scenario: Scenario,
    latency_ms: tuple[float, float] | None = None,
    version: str = VERSION,
    *,
    overlaps: bool = True,
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
    rng = np.random.default_rng(seed)
    planned = planned_mishaps(count, np.random.default_rng(seed)) if rate else {}

    def before_act(action: int) -> None:
        if (kind := planned.get(action)) is not None:
            client.mishaps.plan(kind, float(rng.uniform(0, MISHAP_WITHIN_S)))
        elif rate:
            client.mishaps.maybe(rate, MISHAP_WITHIN_S)

    counts = play_on(client, game, arena, scenario, steps, rng, before_act, is_told=overlaps)
    counts.into_screens, counts.too_late = presses.into_screens, presses.too_late
    return counts


def play_on(
    client: VirtualClient,
    game: LiveGame,
    arena: Arena,
    scenario: Scenario,
    steps: Iterable[object],
    rng: np.random.Generator,
    before_act: Callable[[int], None] = lambda _action: None,
    *,
    is_told: bool = False,
) -> PlayCounts:
    """Play random actions in that client's game, by its clock, and close it; what is then down is counted, too."""
    began, cpu = client.clock.now(), time.process_time()
    with game:
        counts = play_in(
            game, ClientTruth(client, arena), scenario, steps, rng, before_act, client.clock.now, is_told=is_told
        )
    counts.mishaps = len(client.mishaps.happened)
    counts.left_down, counts.strays = len(client.window.down), len(client.window.strays)
    counts.played_s, counts.cpu_s = client.clock.now() - began, time.process_time() - cpu
    return counts


def build_figures(name: str, builds: int, *, overlaps: bool) -> Figures:
    """Build a design so often, once the ticks are known; return an action's and a straight run's seconds, as medians.

    A straight run's seconds a cell are those from its second block to its last.
    """
    client, scenario = VirtualClient(), load_scenario(name)
    arena = Arena.around((-20, client.realm.world.floor, 31), "south", size=size_for(scenario))
    actions, every, straight = build(scenario), list[float](), list[float]()
    with live_game(client, scenario, arena) as game:
        for number in range(builds + 1):
            game.reset(0)
            game.log.seconds.clear()
            for action, following in pairwise([*actions, None]):
                if action is not None:
                    game.act(action, None, (following, None) if overlaps and following is not None else None)
            times = iter(game.log.seconds)
            runs = [[next(times) for _ in run] for _, run in groupby(actions)]
            if number:
                every += game.log.seconds
                straight += [statistics.mean(run[1:]) for run in runs if len(run) >= LEAST_STRAIGHT]
    figures = {"median_action_s": percentile(every, 50), "straight_s": percentile(straight, 50)}
    return figures if straight else {"median_action_s": figures["median_action_s"]}


def planned_mishaps(count: int, rng: np.random.Generator) -> dict[int, Kind]:
    """Return before which of so many actions a mishap opens a screen: each kind PLANNED times, if they fit."""
    kinds = [kind for kind in OPEN_SCREENS for _ in range(PLANNED)]
    at = rng.permutation(count)[: len(kinds)]
    return {int(step): kind for step, kind in zip(at, kinds, strict=False)}


def calibrated_walk(client: VirtualClient) -> WalkTable:
    """Measure the walk of a client's player and its latencies, as `calibrate walk` does around where it stands."""
    with tempfile.TemporaryDirectory() as folder:
        font = Path(folder) / "ascii.png"
        font.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
        profile = Profile(game=GameVersion(version=client.settings.version), screen=ScreenTable(font=str(font)))
        with connection_to(client) as connection:
            return walk(CalibrationContext(connection, lambda _: None, lambda _: True), profile).profile.walk


def live_game(
    client: VirtualClient,
    scenario: Scenario,
    arena: Arena,
    walk_table: WalkTable | None = None,
    controller: InputController | None = None,
    *,
    overlaps: bool = True,
) -> LiveGame:
    """Return a live game on a virtual client.

    Its player walks as in ``walk_table``, or as usual; ``controller``, if given, presses its keys. Actions overlap
    where the next one is announced, if they may.
    """
    return LiveGame(
        scenario,
        Profile(game=GameVersion(version=client.settings.version), arena=arena, walk=walk_table or WalkTable()),
        connection_to(client, controller),
        overlaps=overlaps,
    )


def connection_to(client: VirtualClient, controller: InputController | None = None) -> GameConnection:
    """Return a connection to a virtual client, read with its own font."""
    screen = WindowScreen(client.display, _font(), version=client.settings.version)
    return GameConnection(client.devices, controller or InputController(client.devices, InputTable()), screen)


@cache
def _font() -> Font:
    return font_of(drawn_atlas())


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--actions", type=int, default=10_000, help="of the clean run, and of the soak")
    parser.add_argument("--rate", type=float, default=0.01, help="mishaps an action in the soak")
    parser.add_argument("--frames", type=int, default=20_000, help="frames for the reader")
    parser.add_argument("--tesseract", type=int, default=200, help="frames for Tesseract, if it is installed")
    parser.add_argument(
        "--latency-ms", type=float, nargs=2, metavar=("LEAST", "MOST"), help="the age of a picture; calibrates the walk"
    )
    parser.add_argument("--no-overlap", action="store_true", help="wait for each action's end before the next begins")
    parser.add_argument("--builds", type=int, default=BUILDS, help="of each design, each way")
    parser.add_argument("--version", default=VERSION, help="the game's")
    parser.add_argument("--scenario", default="diamond", help="what is built")
    parser.add_argument("--seed", type=int, default=0, help="of all random numbers")


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Play without mishaps, then with them, and read frames."""
    if options.actions < 1 or options.frames < 2 or options.builds < 1:
        raise UserError("--actions and --builds must be at least 1, --frames at least 2")
    latency_ms = tuple(options.latency_ms) if options.latency_ms else None
    if latency_ms and not 0 <= latency_ms[0] <= latency_ms[1] <= LONGEST_LATENCY_MS:
        raise UserError(f"--latency-ms must be two times from 0 to {LONGEST_LATENCY_MS}, the shorter one first")
    cv2.setNumThreads(1)
    scenario = load_scenario(options.scenario)
    overlaps, seed = not options.no_overlap, options.seed
    clean = play(options.actions, 0.0, seed, scenario, latency_ms, options.version, overlaps=overlaps)
    soak = play(options.actions, options.rate, seed + 1, scenario, latency_ms, options.version, overlaps=overlaps)
    ways = {"designs": True, "designs without overlap": False}
    designs: dict[str, dict[str, Figures]] = {way: {} for way in ways}
    for name in DESIGNS:
        for way, way_overlaps in ways.items():
            designs[way][name] = build_figures(name, options.builds, overlaps=way_overlaps)
    frames = reader.read_frames(_font(), options.frames, options.seed, options.tesseract)
    clean_figures = {**figures_of(clean), "unnoticed": clean.unnoticed}
    is_fast = latency_ms is not None or all(clean_figures[name] <= most for name, most in TARGETS[overlaps].items())
    return {
        "soak": {name: getattr(soak, name) for name in SOAK_FIGURES},
        "clean": clean_figures,
        **designs,
        "reader": dataclasses.asdict(frames),
        "speed_over_real_time": round(clean.played_s / clean.cpu_s, 1),
        "cpu_ms_per_action": round(1000 * clean.cpu_s / clean.actions, 3),
    }, clean.is_right and soak.is_right and is_fast and frames.wrong == 0
