"""Measures what a recording costs: actions in a rehearsal window, by turns recorded and not; then they are replayed.

    python scripts/bench_recording.py [--rounds 6] [--actions 40] [--keep DIR] [--json]

Seconds are of wall-clock time, an action's from its call to its confirmation on the screen. Linux, on a display of its
own; the same computer draws without a graphics card. Run nothing beside it. Exit code 1 if a cell or a block was
wrong, a target was missed, or the replay differs.
"""

import argparse
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from rich.console import Console

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.cli.recording_options import live_recorder
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.recording.opened import OFF
from scripts.bench_rehearsal import prepare
from scripts.rehearsal_window import ROOT, mc_nested, open_rehearsal
from scripts.window_display import open_display

MOST_COST_S, MOST_MB_A_MINUTE = 0.007, 10.0
LIMIT_S = 1800.0


def main() -> int:
    """Measure in a window of its own, or, with ``--profile``, in the one that is open on this display."""
    parser = argparse.ArgumentParser(description="What a recording costs.")
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--actions", type=int, default=40, help="in each half of a round")
    parser.add_argument("--keep", type=Path, help="a new folder for the recordings")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--profile", help=argparse.SUPPRESS)
    parser.add_argument("--truth", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--folder", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.profile:
        print(json.dumps(_in_turns(options.profile, options.truth, options.folder, options.rounds, options.actions)))
        return 0
    if not prepare("bench_recording", _say):
        return 2
    figures = _in_a_window(options.rounds, options.actions, options.keep)
    if options.json:
        print(json.dumps(figures))
    else:
        Console().print(figures)
    return 0 if _is_right(figures) else 1


def _in_a_window(rounds: int, actions: int, keep: Path | None) -> dict[str, Any]:
    """Calibrate, play and replay on a display of its own."""
    with (
        signals_as_exit(),
        tempfile.TemporaryDirectory(prefix="mc-nested-recording-") as temporary,
        open_display() as env,
        open_rehearsal(env, Path(temporary), "--fps", "60") as window,
    ):
        folder = Path(temporary)
        profile = folder / "profile.toml"
        calibration = folder / "recordings" / "calibration"
        mc_nested(
            *("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, "--record", calibration),
            env=env,
        )
        command = [sys.executable, __file__, "--profile", str(profile), "--truth", str(window.truth_file)]
        command += ["--folder", str(folder / "recordings"), "--rounds", str(rounds), "--actions", str(actions)]
        done = subprocess.run(  # noqa: S603 - our own
            command, env={**env, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=LIMIT_S, check=False
        )
        if not done.stdout:
            raise RuntimeError(done.stderr or "nothing was said")
        figures: dict[str, Any] = json.loads(done.stdout)
        figures["replay"] = [
            json.loads(mc_nested("replay", each, "--font", window.font, "--json", env=env))
            for each in sorted((folder / "recordings").iterdir())
        ]
        if keep is not None:
            shutil.copytree(folder / "recordings", keep)
            shutil.copy(window.font, keep / "font.png")
        return figures


def _in_turns(profile: str, truth_file: Path, folder: Path, rounds: int, actions: int) -> dict[str, Any]:
    """Play by turns with and without a recording, each half of a round in the same order of actions."""
    from mc_nested.arena.scenario_file import load_scenario
    from mc_nested.live.profile.store import load_profile
    from mc_nested.live.recording.overview import overview_of
    from mc_nested.live.session import open_live_game
    from scripts.bench_standin import play
    from scripts.rehearsal_window import RehearsalTruth

    scenario = load_scenario("diamond")
    truth = RehearsalTruth(truth_file, load_profile(profile).marked_arena())
    seconds: dict[bool, list[float]] = {False: [], True: []}
    wrong = size = 0
    lasted = 0.0
    for number in range(rounds):
        for is_recorded in (number % 2 == 0, number % 2 == 1):
            where = folder / f"play-{number}"
            recorder = live_recorder(str(where) if is_recorded else OFF, "bench", scenario)
            with open_live_game(scenario, profile, _say, open_recorder=recorder) as (game, _):
                played = play(game, scenario, truth, actions, number)
                seconds[is_recorded] += game.log.seconds
            wrong += played.wrong_cells + played.wrong_blocks
            if is_recorded:
                seen = overview_of(where)
                size, lasted = size + seen.size, lasted + seen.seconds
    plain, recorded = seconds[False], seconds[True]
    return {
        "actions": len(plain) + len(recorded),
        "wrong": wrong,
        "median_s": {"plain": statistics.median(plain), "recorded": statistics.median(recorded)},
        "mean_s": {"plain": statistics.fmean(plain), "recorded": statistics.fmean(recorded)},
        "cost_s": statistics.median(recorded) - statistics.median(plain),
        "mb_a_minute": size / 1e6 / (lasted / 60),
    }


def _say(line: str) -> None:
    print(line, file=sys.stderr)


def _is_right(figures: dict[str, Any]) -> bool:
    return bool(
        not figures["wrong"]
        and figures["cost_s"] <= MOST_COST_S
        and figures["mb_a_minute"] <= MOST_MB_A_MINUTE
        and not any(each["differences"] for each in figures["replay"])
    )


if __name__ == "__main__":
    sys.exit(main())
