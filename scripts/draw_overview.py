"""Draws README's picture: what a training learned, what it builds, and what it reads on a game's screen.

Usage: python scripts/draw_overview.py RUN [OUT.png]    (RUN: the folder of a training, mc-nested train --out)
"""

import csv
import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mc_nested.arena.drawing import draw_picture
from mc_nested.cli.evaluate import greedy_episodes, load_agent
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import font_of
from mc_nested.report.curve import MEAN, OPTIMUM, align_trials, t_interval
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.f3_screen import F3Screen
from sim.grid import arena_env

DEFAULT_OUT = Path(__file__).with_name("overview.png")


def main() -> None:
    """Draw the three panels side by side."""
    folder = RunFolder.open(Path(sys.argv[1]))
    out = Path(sys.argv[2]) if len(sys.argv) > 2 else DEFAULT_OUT
    figure = Figure(figsize=(13, 4), dpi=130, layout="constrained")
    learnt, built, read = figure.subplots(1, 3, width_ratios=[1.25, 0.9, 1.35])
    draw_learnt(learnt, folder)
    draw_built(built, folder)
    draw_read(read)
    figure.savefig(out, metadata={"Software": None})
    print(out)


def draw_learnt(axes: Axes, folder: RunFolder) -> None:
    """The run's learning curve."""
    with (folder.path / "evaluations.csv").open(newline="") as file:
        rows = [(int(row["trial"]), int(row["episode"]), float(row["score"])) for row in csv.DictReader(file)]
    episodes, scores = align_trials(rows, folder.config.trials)
    low, high = t_interval(scores, folder.scenario.optimum)
    axes.axhline(folder.scenario.optimum, color=OPTIMUM, linestyle="--", linewidth=1.2, label="optimum")
    axes.fill_between(episodes, low, high, color=MEAN, alpha=0.2, linewidth=0, label="95 % interval")
    axes.plot(episodes, scores.mean(axis=0), color=MEAN, label=f"mean of {folder.config.trials} trials")
    axes.set(title="learnt in the simulator", xlabel="training episodes", ylabel="score of a greedy episode")
    axes.grid(alpha=0.25)
    axes.legend(loc="lower right", frameon=False)


def draw_built(axes: Axes, folder: RunFolder) -> None:
    """What the first trial's policy builds, the far edge on top."""
    env = arena_env(folder.scenario)
    env.reset()
    for action in greedy_episodes(folder, load_agent(folder))[0].actions:
        env.step(action)
    axes.imshow(draw_picture(folder.scenario, env.cell, env.placed), interpolation="nearest")
    axes.set(title=f"what it builds: the {folder.scenario.name}", xticks=[], yticks=[])


def draw_read(axes: Axes) -> None:
    """A debug screen, in the font that was drawn for this project, and what is read on it."""
    random = np.random.default_rng(2)
    sky = np.linspace((235, 190, 140), (250, 225, 200), 300)[:, None] + np.zeros((1, 854, 1))
    grass = random.normal((70, 130, 85), 12, (180, 854, 3))
    world = np.concatenate((sky, grass)).clip(0, 255).astype(np.uint8)
    target = Target((8, 64, 13), "minecraft:stone")
    screen = F3Screen("1.19.3-1.21.8", gui_scale=2, xyz=(8.487, 64.0, 12.514), yaw=0.0, pitch=65.0, target=target)
    font = font_of(drawn_atlas())
    frame = paint(world, screen, font)
    reading = read_debug_screen(frame, font)
    axes.imshow(frame[:, :, ::-1])
    axes.set(title="what it reads on a game's screen", xticks=[], yticks=[])
    axes.set_xlabel(
        f"xyz {reading.xyz}, yaw {reading.yaw}, pitch {reading.pitch}\nlooks at {reading.target and reading.target.id}"
        f" {reading.target and reading.target.pos}"
    )


if __name__ == "__main__":
    main()
