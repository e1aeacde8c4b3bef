"""How well a calibration does by itself: random virtual clients, each calibrated and then played in.

    python scripts/bench_calibration.py [--clients 50] [--actions 200] [--seed 0] [--json]

Each client (scripts/calibration_clients.py) is met as a person leaves it: a world, a player who looks about along an
axis, the debug screen on, no profile. `calibrate all --yes` is what runs, with nobody there; then ``actions`` random
actions are played from the profile that it wrote, each against what the client's world holds. A client counts as
unattended where a profile came of it. Seconds are the game's; ``longest_game_s`` and ``median_game_s`` are those of the
calibration alone. ``walk_rms_blocks`` is how far the profile's holds are off the client's physics, the worst client's;
``click_off_gui_px_max`` how far any recorded point is from its button's middle. Exit code 1 where a target is missed.
"""

import argparse
import dataclasses
import json
import math
import statistics
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cv2
from rich.console import Console
from rich.progress import track
from rich.table import Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from calibration.all import calibrate_all
from calibration.bench import BenchOf
from calibration.doctor.check import Check
from calibration.doctor.examination import examine
from calibration.game.folders import System
from calibration.step import Bench, Found
from calibration.steps import guided_steps
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import McNestedError
from mc_nested.live.desktop import Desktop
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.hands import Hands
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile, load_profile
from mc_nested.live.session import overlay_of
from scripts.bench_live import Play, play_in
from scripts.calibration_clients import clients
from sim.client.client import VirtualClient
from sim.client.font import drawn_atlas
from sim.client.physics import Ground, displacement
from sim.client.screens import MenuState, ScreenName, menu
from sim.client.settings import ClientSettings

TARGETS = {"longest_game_s": 300.0, "walk_rms_blocks": 0.02, "click_off_gui_px_max": 2.0}

BUTTONS: dict[str, tuple[ScreenName, str]] = {
    "back_to_game": ("pause", "Back to Game"),
    "save_and_quit_to_title": ("pause", "Save and Quit to Title"),
    "singleplayer": ("title", "Singleplayer"),
    "play_selected_world": ("worlds", "Play Selected World"),
}
"""The points whose buttons have a label, hence a middle: a world's row has none."""


@dataclasses.dataclass
class Calibrated:
    """What one client's calibration and the playing after it came to; ``problem`` is why there was none."""

    settings: ClientSettings
    problem: str = ""
    game_s: float = 0.0
    passed_over: tuple[str, ...] = ()
    walk_rms: float = 0.0
    clicks_off: tuple[float, ...] = ()
    play: Play = dataclasses.field(default_factory=Play)

    @property
    def wrong(self) -> int:
        """Cells, blocks and outcomes that were not as they should be."""
        return self.play.wrong_cells + self.play.wrong_blocks + self.play.unnoticed


class Silent:
    """Nobody watches."""

    def checked(self, checks: Sequence[Check]) -> None:
        """Say nothing."""

    def begin(self, name: str, number: int, of: int) -> None:
        """Say nothing."""

    def end(self, found: Found, seconds: float) -> None:
        """Say nothing."""

    def passed_over(self, reason: str, seconds: float) -> None:
        """Say nothing."""


def calibrated(settings: ClientSettings, folder: Path, actions: int, scenario: Scenario) -> Calibrated:
    """Calibrate a client with a profile in that folder, and play so many actions in it."""
    client = VirtualClient(settings)
    done = Calibrated(settings)
    profile_file = folder / "default.toml"
    began = client.clock.now()
    try:
        whole = calibrate_all(
            str(profile_file), bench_of(client), examined_by(client, folder), guided_steps(font_in(folder)), Silent()
        )
    except McNestedError as error:
        done.problem = f"{type(error).__name__}: {error}"
        return done
    finally:
        done.game_s = client.clock.now() - began
    done.passed_over = tuple(whole.guided.passed_over)
    profile = load_profile(profile_file)
    done.walk_rms = walk_off(profile, settings)
    done.clicks_off = tuple(clicks_off(profile, client))
    game = live_game(client, profile, scenario)
    try:
        done.play = play_in(client, game, profile.marked_arena(), scenario, range(actions), 0.0, settings.seed)
    except McNestedError as error:
        done.problem = f"playing: {type(error).__name__}: {error}"
    done.play.left_down = len(client.window.down)
    return done


def bench_of(client: VirtualClient) -> BenchOf:
    """Opens benches over a client, wired as a desktop's, whose person says yes to everything."""

    @contextmanager
    def opened(profile: Profile) -> Iterator[Bench]:
        desktop = desktop_of(client)
        with Hands(desktop.display, desktop.keyboard, desktop.pointer, desktop.clock, profile.input) as hands:
            yield Bench(desktop, hands, lambda _: None, lambda _: True)

    return opened


def desktop_of(client: VirtualClient) -> Desktop:
    """A client's devices."""
    return Desktop(client.display, client.keyboard, client.pointer, client.clock, client.clipboard, client.display.size)


def examined_by(client: VirtualClient, folder: Path) -> Any:
    """The doctor, on a computer without any launcher's folder, whose one window is the client's."""

    @contextmanager
    def open_devices(_title: str) -> Iterator[Desktop]:
        yield desktop_of(client)

    def examined(profile_name: str) -> Sequence[Check]:
        return examine(
            profile_name,
            say=lambda _: None,
            system=System("linux", folder / "home", {}),
            clipboard=client.clipboard,
            open_devices=open_devices,
            session=lambda: "virtual",
            processes=lambda: (),
        ).checks

    return examined


def live_game(client: VirtualClient, profile: Profile, scenario: Scenario) -> LiveGame:
    """The live path from a profile alone, wired to a client."""
    font = load_font(profile.screen.font_path())
    return LiveGame(
        scenario,
        profile,
        display=client.display,
        keyboard=client.keyboard,
        pointer=client.pointer,
        clock=client.clock,
        screen=WindowScreen(client.display, font, overlay_of(profile)),
    )


def font_in(folder: Path) -> Path:
    """The virtual clients' own font as a picture in a folder."""
    file = folder / "ascii.png"
    file.write_bytes(cv2.imencode(".png", drawn_atlas())[1].tobytes())
    return file


def walk_off(profile: Profile, settings: ClientSettings) -> float:
    """Root mean square, in blocks, of what lies between a profile's holds and the client's physics."""
    ground = Ground(settings.slipperiness, settings.speed)
    off = [covered - displacement(ticks, "walk", ground) for ticks, covered in enumerate(profile.walk.covered, 1)]
    return math.sqrt(statistics.fmean(each**2 for each in off))


def clicks_off(profile: Profile, client: VirtualClient) -> Iterator[float]:
    """How far each recorded point that has a button is off its middle, in GUI pixels, the farther of both axes."""
    (width, height), scale = client.window.size, client.scale
    for name, (screen, label) in BUTTONS.items():
        if name not in profile.points:
            continue
        state = MenuState(screen, is_chosen=True)
        buttons = menu(state, client.edition, -(-width // scale), -(-height // scale)).buttons
        middle = next(button.middle for button in buttons if button.label == label)
        point = profile.points[name]
        yield max(abs(point[0] * width / scale - middle[0]), abs(point[1] * height / scale - middle[1]))


def report(done: Sequence[Calibrated]) -> dict[str, Any]:
    """What --json prints."""
    good = [each for each in done if not each.problem]
    times = [each.game_s for each in done]
    offs = [off for each in good for off in each.clicks_off]
    return {
        "clients": len(done),
        "unattended": len(good),
        "wrong_cells": sum(each.play.wrong_cells for each in done),
        "wrong_blocks": sum(each.play.wrong_blocks for each in done),
        "unnoticed": sum(each.play.unnoticed for each in done),
        "actions": sum(each.play.actions for each in done),
        "failed_actions": sum(each.play.failed_actions for each in done),
        "gave_up": sum(each.play.gave_up for each in done),
        "left_down": sum(each.play.left_down for each in done),
        "corrections": sum(each.play.corrections for each in done),
        "longest_game_s": round(max(times, default=0.0), 1),
        "median_game_s": round(statistics.median(times), 1) if times else 0.0,
        "walk_rms_blocks": round(max((each.walk_rms for each in good), default=0.0), 5),
        "click_points": len(offs),
        "click_off_gui_px_max": round(max(offs, default=0.0), 2),
        "steps_passed_over": sum(len(each.passed_over) for each in done),
        "versions": len({each.settings.version for each in done}),
        "problems": [f"{each.settings.version} {each.settings.size}: {each.problem}" for each in done if each.problem],
    }


def main() -> int:
    """Parse the command line, measure, print."""
    parser = argparse.ArgumentParser(description="How well a calibration does by itself, on random virtual clients.")
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--actions", type=int, default=200, help="played with each profile")
    parser.add_argument("--scenario", default="diamond")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if arguments.clients < 1 or arguments.actions < 1:
        parser.error("--clients and --actions must be at least 1")
    cv2.setNumThreads(1)
    scenario, console = load_scenario(arguments.scenario), Console(stderr=True)
    done = []
    chosen = list(clients(arguments.clients, arguments.seed))
    for settings in track(chosen, "clients", console=console):
        with tempfile.TemporaryDirectory() as folder:
            done.append(calibrated(settings, Path(folder), arguments.actions, scenario))
        if done[-1].problem or done[-1].wrong or done[-1].passed_over:
            console.print(f"{settings}: {done[-1].problem or f'{done[-1].wrong} wrong'} {done[-1].passed_over}")
    result = report(done)
    print(json.dumps(result)) if arguments.json else _show(result)
    right = result["unattended"] == result["clients"] and not any(each.wrong or each.play.gave_up for each in done)
    return int(not (right and all(result[name] <= most for name, most in TARGETS.items())))


def _show(result: dict[str, Any]) -> None:
    table = Table(show_header=False)
    for key, value in result.items():
        table.add_row(key, str(value))
    Console().print(table)


if __name__ == "__main__":
    sys.exit(main())
