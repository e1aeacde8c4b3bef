"""Draws README's picture: what a training learnt, what it builds, and what it reads on a game's screen.

Usage: python scripts/draw_overview.py RUN [OUT.png]    (RUN: the folder of a training, mc-nested train --out)
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mc_nested.arena.drawing import draw_picture
from mc_nested.cli.evaluate import greedy_episodes, load_agent
from mc_nested.learn.run_folder import RunFolder
from mc_nested.live.debug_screen import read_debug_screen
from mc_nested.live.font import font_of
from mc_nested.report.curve import MEAN, OPTIMUM, align_trials, bootstrap_interval
from sim.client.f3 import paint
from sim.client.f3_text import F3Screen
from sim.client.font import drawn_atlas
from sim.grid import arena_env

DEFAULT_OUT = Path(__file__).with_name("overview.png")


def main() -> None:
    """Draw the three panels side by side."""
    folder = RunFolder.open(Path(sys.argv[1]))
    out = Path(sys.argv[2]) if len(sys.argv) > 2 else DEFAULT_OUT
    figure = Figure(figsize=(13, 4), dpi=100, layout="constrained")
    learnt, built, read = figure.subplots(1, 3, width_ratios=[1.25, 0.9, 1.35])
    draw_learnt(learnt, folder)
    draw_built(built, folder)
    draw_read(read)
    figure.savefig(out, metadata={"Software": None})
    print(out)
