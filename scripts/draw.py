"""Draws the pictures of the documentation that show a game, and README's film.

    python scripts/draw.py rehearsal [OUT.png]                           the rehearsal window: the diamond, half built
    python scripts/draw.py film [OUT.gif|OUT.mp4] [--scenario diamond]    the agent builds in the rehearsal window
    python scripts/draw.py view [FOLDER] [--seconds 45]                  the live view, and the calibration report
    python scripts/draw.py overlap [OUT.png]                             actions that wait, and that overlap

On Linux the rehearsal needs a display with OpenGL; Xvfb's will do (xvfb-run -a). Film
and view calibrate from nothing, which takes two minutes, on a display of their own. The view is looked at after so many
seconds of a training: view.svg is what Textual drew, and report.png what Chromium shows of the report, where there is
one. Without OUT or FOLDER, the picture is the documentation's, in scripts/.
"""

import argparse
import asyncio
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2
import moderngl
import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from calibration.report.page import report_path
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import UserError
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.profile.arena import Arena
from mc_nested.view.app import ViewApp
from scripts.benches.rehearsal import prepare
from scripts.overlap_picture import draw_overlap
from scripts.programs import ROOT
from scripts.rehearsal_window import mc_nested, open_rehearsal
from scripts.window_display import open_display, running
from sim.client.client import VirtualClient
from sim.client.game.realm import Stack
from sim.window.glfw_window import open_glfw_window
from sim.window.window_picture import WindowPicture

SIZE, BUILT, PITCH = (854, 480), 13, 27.0
"""Of the rehearsal's picture: its size, how many blocks are built, and how far down the player looks."""

FILMED = ("--size", "1344x960", "--gui-scale", "1", "--fps", "60")
"""At this scale the chat, which stays grey in a film, covers little."""

VIEW_SIZE = (96, 28)
WEB_FONT = re.compile(r"@font-face \{.*?\}\s*", re.DOTALL)
REPORT_SIZE = "1100,1600"
REPORT_PART = (90, 820, 1010, 1535)
"""What of the page is drawn, as left, top, right and lower edge: how the screen was read, line by line."""
ENDS_S = 60.0


def main() -> int:
    """Draw what is asked for; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = parser.add_subparsers(dest="name", required=True)
    pictures = {"rehearsal": "rehearsal.png", "film": "build.gif", "view": "", "overlap": "overlap.png"}
    parsers = {name: names.add_parser(name) for name in pictures}
    for name, picture in pictures.items():
        parsers[name].add_argument("out", nargs="?", type=Path, default=ROOT / "scripts" / picture)
    parsers["film"].add_argument("--scenario", default="diamond")
    parsers["view"].add_argument("--seconds", type=float, default=45.0)
    options = parser.parse_args()
    try:
        if options.name == "rehearsal":
            draw_rehearsal(options.out)
        elif options.name == "overlap":
            draw_overlap(options.out)
        elif options.name == "film":
            draw_film(options.scenario, options.out)
        else:
            draw_view(options.seconds, options.out)
    except UserError as error:
        parser.error(str(error))
    return 0


def draw_rehearsal(out: Path) -> None:
    """Draw the rehearsal window, in which the diamond is half built."""
    arena = Arena.around((0, 64, 0), "south")
    x, y, z = arena.block_of((7, 0))
    client = VirtualClient(size=SIZE, floor_block="grass_block", feet=(x + 0.5, float(y), z - 0.9), pitch=PITCH)
    scenario = load_scenario("diamond")
    for cell in sorted(scenario.design, key=lambda cell: cell[1])[:BUILT]:
        client.realm.world.put(arena.block_of(cell), "stone")
    for across in range(-1, 16):
        for right, forward in ((across, -1), (across, 15), (-1, across), (15, across)):
            client.realm.world.put((x + 7 - right, y - 1, z + forward), "glowstone")
    client.realm.player.hotbar[:2] = [Stack("oak_planks", 64), Stack("stone", 64)]
    client.realm.player.slot = 1
    client.clock.sleep(0.5)
    with open_glfw_window("Minecraft", SIZE) as window:
        context = moderngl.create_context(require=330)
        picture = WindowPicture(context, client)
        picture.has_changed()
        picture.draw()
        pixels = np.frombuffer(context.screen.read(window.size, 3, alignment=1), np.uint8)
        cv2.imwrite(str(out), pixels.reshape(*window.size[::-1], 3)[::-1, :, ::-1])


@contextmanager
def _calibrated(*options: str) -> Iterator[tuple[dict[str, str], Path, Path]]:
    """Open a calibrated rehearsal window: the environment of what plays in it, its profile, and an empty folder."""
    prepare(lambda line: print(line, file=sys.stderr))
    with (
        signals_as_exit(),  # or an ended program would leave its window and its screen behind
        tempfile.TemporaryDirectory(prefix="mc-nested-draw-") as temporary,
        open_display() as env,
        open_rehearsal(env, Path(temporary), *options) as window,
    ):
        profile = Path(temporary) / "profile.toml"
        mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, env=env)
        yield env, profile, Path(temporary) / "run"


def draw_film(scenario: str, out: Path) -> None:
    """Film how the agent that builds any design builds this one in the rehearsal window."""
    with _calibrated(*FILMED) as (env, profile, _):
        live = ("--backend", "live", "--profile", profile)
        print(mc_nested("build", scenario, "--agent", *live, "--video", out.resolve(), env=env))


def draw_view(seconds: float, folder: Path) -> None:
    """Draw the view of a training after so many seconds, and the report of the calibration before it."""
    with _calibrated("--fps", "60") as (env, profile, run):
        _draw_report(report_path(profile), folder / "report.png")
        live = ("--backend", "live", "--profile", str(profile), "--preset", "model-based", "--scenario", "diamond")
        command = [sys.executable, "-m", "mc_nested.cli", "train", *live, "--out", str(run)]
        with running(command, env={**env, "PYTHONPATH": str(ROOT)}, log=run.with_name("train.log")) as training:
            time.sleep(seconds)
            (folder / "view.svg").write_text(asyncio.run(_view_of(run)), encoding="utf-8")
            training.send_signal(signal.SIGINT)
            training.wait(ENDS_S)


async def _view_of(run: Path) -> str:
    """Return the view of a run as SVG, drawn with the reader's own font: nothing is fetched."""
    app = ViewApp(run)
    async with app.run_test(size=VIEW_SIZE) as pilot:
        await pilot.pause(1.0)
        svg = app.export_screenshot(title="mc-nested train --view")
    return WEB_FONT.sub("", svg).replace("Fira Code", "monospace")


def _draw_report(report: Path, picture: Path) -> None:
    browser = shutil.which("chromium")
    if browser is None:
        print("no chromium here, so no report.png is drawn", file=sys.stderr)
        return
    command = [browser, "--headless", "--hide-scrollbars", f"--window-size={REPORT_SIZE}"]
    command += ["--no-sandbox"] if os.geteuid() == 0 else []
    subprocess.run([*command, f"--screenshot={picture.resolve()}", report.resolve().as_uri()], check=True)  # noqa: S603
    with Image.open(picture) as page:
        part = page.crop(REPORT_PART)
    part.save(picture)


if __name__ == "__main__":
    sys.exit(main())
