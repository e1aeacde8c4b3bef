"""Calibrating and playing in a real window, the rehearsal's, in real time; its client checks what is done.

First `calibrate all` from nothing, and ``--actions`` actions, at 60 frames a second. Then, one factor at a time, a new
calibration and ``--each`` actions: at 10, 20, 30 and 144 frames a second; on the keyboards of France, Germany and
Russia, and on Dvorak's; with a window manager. Actions are drawn uniformly from those that the rules don't void.
Seconds are of wall-clock time, an action's from its call to its confirmation on the screen. Linux, on a display of its
own; the same computer draws without a graphics card. Wrong are a wrong cell or block, and a calibration that fails.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import UserError
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.profile.store import load_profile
from mc_nested.live.session import Opening, open_live_game
from scripts.bench import Figures
from scripts.benches.played import WorldTruth, figures_of, play_in
from scripts.programs import ROOT, MissingError, Say
from scripts.rehearsal_window import TruthReader, mc_nested, open_rehearsal
from scripts.window_display import install_programs, open_display

MOST_MEDIAN_S = 0.36
MOST_CALIBRATION_S = 100.0
START_S, LONGEST_ACTION_S = 120.0, 6.0


@dataclass(frozen=True)
class Condition:
    """One way to rehearse; ``options`` are more of ``mc-nested rehearse``'s."""

    name: str
    fps: float = 60.0
    layout: str = "us"
    has_window_manager: bool = False
    options: tuple[str, ...] = ()


USUAL = Condition("60 fps")
CONDITIONS = (
    USUAL,
    *(Condition(f"{fps} fps", fps=fps) for fps in (10, 20, 30, 144)),
    *(Condition(layout, layout=layout) for layout in ("fr", "de", "dvorak", "ru")),
    Condition("openbox", has_window_manager=True),
)


def calibrate_and_play(condition: Condition, actions: int, seed: int) -> dict[str, Any]:
    """Calibrate and play under one condition; ``problem`` says what failed."""
    with (
        signals_as_exit(),  # or an ended benchmark would leave its window and its screen behind
        tempfile.TemporaryDirectory(prefix="mc-nested-rehearsal-") as temporary,
        open_display(layout=condition.layout, has_window_manager=condition.has_window_manager) as env,
        open_rehearsal(env, Path(temporary), "--fps", str(condition.fps), *condition.options) as window,
    ):
        profile = Path(temporary) / "profile.toml"
        began = time.monotonic()
        try:
            mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, env=env)
            figures = {"calibration_s": round(time.monotonic() - began, 1)}
            return figures | play(profile, window.truth_file, actions, seed, env)
        except (RuntimeError, subprocess.TimeoutExpired) as error:
            return {"problem": str(error).strip().splitlines()[-1]}


def play(profile: Path, truth: Path, actions: int, seed: int, env: dict[str, str]) -> dict[str, Any]:
    """Play so many actions in the window on that display; RuntimeError with what was said where that fails.

    In a process of its own: a program keeps to the display that it was started on.
    """
    command = [sys.executable, "-m", "scripts.benches.rehearsal", str(profile), str(truth), str(actions), str(seed)]
    limit_s = START_S + actions * LONGEST_ACTION_S
    done = subprocess.run(  # noqa: S603 - our own
        command, cwd=ROOT, env=env, capture_output=True, text=True, timeout=limit_s, check=False
    )
    if not done.stdout:
        raise RuntimeError(done.stderr or "nothing was said")
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures


def play_here(profile: str, truth: str, actions: str, seed: str) -> None:
    """Play so many random actions on this process's display, and print the figures as one JSON object."""
    scenario = load_scenario("diamond")
    client = TruthReader(Path(truth))
    seen = WorldTruth(load_profile(profile).marked_arena(), client.way, client.built)
    with open_live_game(scenario, Opening(profile, lambda line: print(line, file=sys.stderr))) as (game, _):
        steps = track(range(int(actions)), "actions", console=Console(stderr=True))
        played = play_in(game, seen, scenario, steps, np.random.default_rng(int(seed)), is_told=True)
    print(json.dumps(figures_of(played)))


def prepare(say: Say) -> None:
    """Install what a real window needs; UserError where that is impossible."""
    with tempfile.TemporaryDirectory(prefix="mc-nested-apt-") as logs:
        try:
            install_programs(say, Path(logs) / "apt.log")
        except MissingError as error:
            raise UserError(str(error)) from error


def is_right_under(condition: Condition, figures: dict[str, Any]) -> bool:
    """Return whether nothing was wrong, and the usual condition is within its targets."""
    if "problem" in figures or figures["wrong_cells"] or figures["wrong_blocks"]:
        return False
    if condition != USUAL:
        return True
    return bool(figures["median_action_s"] <= MOST_MEDIAN_S and figures["calibration_s"] <= MOST_CALIBRATION_S)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add the options, with their defaults."""
    parser.add_argument("--actions", type=int, default=1000, help="at 60 frames a second")
    parser.add_argument("--each", type=int, default=100, help="under each other condition")
    parser.add_argument("--only", nargs="+", choices=[each.name for each in CONDITIONS], help="these conditions alone")
    parser.add_argument("--seed", type=int, default=0)


def measure(options: argparse.Namespace) -> tuple[Figures, bool]:
    """Calibrate and play under every condition."""
    say = Console(stderr=True).print
    prepare(say)
    found: dict[str, dict[str, Any]] = {}
    for condition in CONDITIONS:
        if options.only and condition.name not in options.only:
            continue
        count = options.actions if condition == USUAL else options.each
        say(f"{condition.name}: a calibration, then {count} actions")
        found[condition.name] = calibrate_and_play(condition, count, options.seed)
        say(str(found[condition.name]))
    return found, all(is_right_under(each, found[each.name]) for each in CONDITIONS if each.name in found)


if __name__ == "__main__":
    play_here(*sys.argv[1:])
