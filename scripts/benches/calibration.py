"""How well random virtual clients are calibrated unattended, and then played in.

Each client (calibration_clients.py) is as a person leaves it: in a world, the player looking roughly along an axis, the
debug screen on, no profile. `calibrate all --yes` runs unattended. Then ``actions`` random actions are played with the
new profile, each checked against the client's world. A client counts as unattended if it got a profile. Seconds are the
game's; ``longest_game_s`` and ``median_game_s`` are those of the calibration alone. ``walk_rms_blocks`` is the worst
client's error of the profile's walk against the client's physics; ``click_off_gui_px_max`` is the largest distance of a
recorded point from its button's middle.
"""

import argparse
import dataclasses
import math
import statistics
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from rich.console import Console
from rich.progress import track

from calibration.calibrate_all import Examine, calibrate_all, registered_steps
from calibration.context import CalibrationContext, OpenContext, StepResult
from calibration.doctor.check import Check
from calibration.doctor.examination import examine
from calibration.installation.folders import System
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import McNestedError, UserError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import size_for
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile
from scripts.bench import Figures
from scripts.benches.calibration_clients import VERSIONS, clients, every_version
from scripts.benches.live import play_on
from scripts.benches.played import PlayCounts
from scripts.benches.walked import displacement
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.physics import Ground
from sim.client.game.screens import MenuState, ScreenName, menu
from sim.client.settings import ClientSettings

PLAYED = (
    "wrong_cells",
    "wrong_blocks",
    "unnoticed",
    "actions",
    "failed_actions",
    "gave_up",
    "left_down",
    "corrections",
)
"""What is summed up over all clients."""

TARGETS = {"longest_game_s": 300.0, "walk_rms_blocks": 0.02, "click_off_gui_px_max": 2.0}

BUTTONS: dict[str, tuple[ScreenName, str]] = {
    "back_to_game": ("pause", "Back to Game"),
    "save_and_quit_to_title": ("pause", "Save and Quit to Title"),
    "singleplayer": ("title", "Singleplayer"),
    "play_selected_world": ("worlds", "Play Selected World"),
}
"""The points whose buttons have a label, so they have a middle; a world in the list has none."""


@dataclasses.dataclass
class ClientResult:
    """One client's calibration, and the playing after it; ``problem`` says what failed."""

    settings: ClientSettings
    problem: str = ""
    game_s: float = 0.0
    skipped: tuple[str, ...] = ()
    walk_rms: float = 0.0
    click_errors: tuple[float, ...] = ()
    play: PlayCounts = dataclasses.field(default_factory=PlayCounts)

    @property
    def wrong(self) -> int:
        """Cells, blocks and outcomes that were wrong."""
        return self.play.wrong_cells + self.play.wrong_blocks + self.play.unnoticed


class SilentProgress:
    """Shows nothing."""

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """Show nothing."""

    def begin(self, name: str, number: int, of: int) -> None:
        """Show nothing."""

    def end(self, result: StepResult, seconds: float) -> None:
        """Show nothing."""

    def skip(self, reason: str, seconds: float) -> None:
        """Show nothing."""


def calibrate_and_play(settings: ClientSettings, folder: Path, actions: int, scenario: Scenario) -> ClientResult:
    """Calibrate a client with a profile in that folder, and play so many actions in it."""
    client = VirtualClient(settings)
    result = ClientResult(settings)
    profile_file = folder / "default.toml"
    began = client.clock.now()
    try:
        calibration = calibrate_all(
            str(profile_file),
            context_opener_for(client),
            doctor_for(client, folder),
            registered_steps(write_font(folder), size=size_for(scenario)),
            SilentProgress(),
        )
    except McNestedError as error:
        result.problem = f"{type(error).__name__}: {error}"
        return result
    finally:
        result.game_s = client.clock.now() - began
    result.skipped = tuple(calibration.run.skipped)
    profile = load_profile(profile_file)
    result.walk_rms = walk_rms(profile, settings)
    result.click_errors = tuple(click_errors(profile, client))
    game = live_game(client, profile, scenario)
    try:
        rng = np.random.default_rng(settings.seed)
        result.play = play_on(client, game, profile.marked_arena(), scenario, range(actions), rng)
    except McNestedError as error:
        result.problem = f"playing: {type(error).__name__}: {error}"
    result.play.left_down = len(client.window.down)
    return result


def context_opener_for(client: VirtualClient) -> OpenContext:
    """Return what opens contexts on a client, connected as on a desktop, whose person says yes to everything."""

    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        with GameConnection(client.devices, InputController(client.devices, profile.input)) as connection:
            yield CalibrationContext(connection, lambda _: None, lambda _: True)

    return opened


def doctor_for(client: VirtualClient, folder: Path) -> Examine:
    """Return the doctor, on a computer without any launcher's folder, whose one window is the client's."""

    @contextmanager
    def open_devices(_title: str) -> Iterator[Devices]:
        yield client.devices

    def checks(profile_name: str) -> Sequence[Check]:
        return examine(
            profile_name,
            say=lambda _: None,
            system=System("linux", folder / "home", {}),
            clipboard=client.clipboard,
            open_devices=open_devices,
            session=lambda: "virtual",
            processes=lambda: (),
            font=folder / "ascii.png",
        ).checks

    return checks


def live_game(client: VirtualClient, profile: Profile, scenario: Scenario) -> LiveGame:
    """Return a live game on a client, from the profile alone."""
    connection = GameConnection(client.devices, InputController(client.devices, profile.input))
    return LiveGame(scenario, profile, connection.for_profile(profile))


def write_font(folder: Path) -> Path:
    """Write the virtual clients' own font as a picture into a folder; returns its file."""
    file = folder / "ascii.png"
    file.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return file


def walk_rms(profile: Profile, settings: ClientSettings) -> float:
    """Return root mean square, in blocks, of the differences between a profile's walk and the client's physics."""
    ground = Ground(settings.slipperiness, settings.speed)
    errors = [covered - displacement(ticks, "walk", ground) for ticks, covered in enumerate(profile.walk.covered, 1)]
    return math.sqrt(statistics.fmean(each**2 for each in errors))


def click_errors(profile: Profile, client: VirtualClient) -> Iterator[float]:
    """Yield each recorded point's distance from its button's middle in GUI pixels, along the worse axis."""
    (width, height), scale = client.window.size, client.scale
    for name, (screen, label) in BUTTONS.items():
        if name not in profile.points:
            continue
        state = MenuState(screen, is_chosen=True)
        buttons = menu(state, client.edition, -(-width // scale), -(-height // scale)).buttons
        middle = next(button.middle for button in buttons if button.label == label)
        point = profile.points[name]
        yield max(abs(point[0] * width / scale - middle[0]), abs(point[1] * height / scale - middle[1]))


def report(results: Sequence[ClientResult]) -> dict[str, Any]:
    """Return what --json prints."""
    good = [each for each in results if not each.problem]
    times = [each.game_s for each in results]
    errors = [error for each in good for error in each.click_errors]
    return {
        "clients": len(results),
        "unattended": len(good),
        **{name: sum(getattr(each.play, name) for each in results) for name in PLAYED},
        "longest_game_s": round(max(times, default=0.0), 1),
        "median_game_s": round(statistics.median(times), 1) if times else 0.0,
        "walk_rms_blocks": round(max((each.walk_rms for each in good), default=0.0), 5),
        "click_points": len(errors),
        "click_off_gui_px_max": round(max(errors, default=0.0), 2),
        "steps_passed_over": sum(len(each.skipped) for each in results),
        "versions": len({each.settings.version for each in results}),
        "problems": [
            f"{each.settings.version} {each.settings.size}: {each.problem}" for each in results if each.problem
        ],
    }


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument(
        "--every-version",
        action="store_true",
        help="each version in seven windows, the game's options at their defaults",
    )
    parser.add_argument(
        "--version", action="append", choices=VERSIONS, help="only the chosen clients of this version; may be repeated"
    )
    parser.add_argument("--actions", type=int, default=200, help="played with each profile")
    parser.add_argument("--scenario", default="diamond")
    parser.add_argument("--seed", type=int, default=0)


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Calibrate every client, and play in each."""
    if options.clients < 1 or options.actions < 1:
        raise UserError("--clients and --actions must be at least 1")
    cv2.setNumThreads(1)
    scenario, console = load_scenario(options.scenario), Console(stderr=True)
    results: list[ClientResult] = []
    everyone = every_version(options.seed) if options.every_version else clients(options.clients, options.seed)
    chosen = [each for each in everyone if not options.version or each.version in options.version]
    for settings in track(chosen, "clients", console=console):
        with tempfile.TemporaryDirectory() as folder:
            results.append(calibrate_and_play(settings, Path(folder), options.actions, scenario))
        if results[-1].problem or results[-1].wrong or results[-1].skipped:
            console.print(f"{settings}: {results[-1].problem or f'{results[-1].wrong} wrong'} {results[-1].skipped}")
    figures = report(results)
    is_right = figures["unattended"] == figures["clients"] and not any(
        each.wrong or each.play.gave_up for each in results
    )
    return figures, is_right and all(figures[name] <= most for name, most in TARGETS.items())
