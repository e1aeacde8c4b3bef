"""Calibrates random rehearsal windows from nothing, and plays in each: versions, sizes, scales, layouts, frame rates.

    python scripts/bench_rehearsal_clients.py [--clients 25] [--actions 40] [--seed 0] [--json]

Versions are those of scripts/calibration_clients.py. Nothing is done by hand. Two minutes a client, in real time: run
nothing beside it. Exit code 1 if a calibration failed, or a cell or a block was wrong.
"""

import argparse
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from scripts.bench_rehearsal import Condition, is_right, measure, prepare
from scripts.calibration_clients import NARROWEST, VERSIONS
from scripts.window_display import SIZE
from sim.client.settings import gui_scale

LAYOUTS = ("us", "fr", "de", "dvorak", "ru")
SLOWEST_FPS, FASTEST_FPS = 20.0, 144.0


def conditions(count: int, seed: int) -> Iterator[Condition]:
    """``count`` random windows, the same for the same seed."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        version, layout = str(rng.choice(VERSIONS)), str(rng.choice(LAYOUTS))
        (width, height), scale = _window(rng)
        fps = round(float(rng.uniform(SLOWEST_FPS, FASTEST_FPS)), 1)
        has_window_manager = bool(rng.random() < 0.5)
        name = f"{number + 1}: {version}, {width}x{height} at {scale}, {fps} fps, {layout}"
        options = ("--version", version, "--size", f"{width}x{height}", "--gui-scale", str(scale))
        yield Condition(name + ", openbox" * has_window_manager, fps, layout, has_window_manager, options)


def _window(rng: np.random.Generator) -> tuple[tuple[int, int], int]:
    """A size that fits the display with its frame, odd or even, and a GUI scale that fits it; 0 is auto."""
    while True:
        size = int(rng.integers(640, SIZE[0] - 20)), int(rng.integers(480, SIZE[1] - 60))
        scale = int(rng.integers(0, 5))
        if size[0] >= NARROWEST * gui_scale(size, scale):
            return size, scale


def main() -> int:
    """Calibrate and play in every window, and print the figures; 1 if anything was wrong."""
    parser = argparse.ArgumentParser(description="Random rehearsal windows, calibrated from nothing and played in.")
    parser.add_argument("--clients", type=int, default=25)
    parser.add_argument("--actions", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    say = Console(stderr=True).print
    if not prepare("bench_rehearsal_clients", say):
        return 2
    found: dict[str, dict[str, Any]] = {}
    right = 0
    for condition in conditions(options.clients, options.seed):
        found[condition.name] = figures = measure(condition, options.actions, options.seed)
        right += is_right(condition, figures)
        say(f"{condition.name}: {figures}")
    if options.json:
        print(json.dumps(found))
    say(f"{right} of {options.clients} calibrated from nothing, and nothing wrong in them")
    return 0 if right == options.clients else 1


if __name__ == "__main__":
    sys.exit(main())
