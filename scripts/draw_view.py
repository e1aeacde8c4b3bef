"""Draws README's pictures of the live view and of the calibration report, of a training in the rehearsal window.

    python scripts/draw_view.py [--folder scripts] [--seconds 45]

It calibrates from nothing, begins a training, and looks at it after so many seconds. view.svg is what Textual drew, and
report.png what Chromium shows of the report, where there is one. Linux, on a display of its own.
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
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from PIL import Image

from calibration.report.write import report_path
from mc_nested.errors import UserError
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.view.app import ViewApp
from scripts.benches.rehearsal import prepare
from scripts.rehearsal_window import ROOT, mc_nested, open_rehearsal
from scripts.window_display import open_display, running

SIZE = (96, 28)
WEB_FONT = re.compile(r"@font-face \{.*?\}\s*", re.DOTALL)
REPORT_SIZE = "1100,1600"
REPORT_PART = (90, 820, 1010, 1535)
"""What of the page is drawn, as left, top, right and lower edge: how the screen was read, line by line."""
ENDS_S = 60.0


def main() -> int:
    """Calibrate, train, and draw; the exit code."""
    parser = argparse.ArgumentParser(description="Draws the live view and the calibration report.")
    parser.add_argument("--folder", type=Path, default=Path(__file__).parent)
    parser.add_argument("--seconds", type=float, default=45.0)
    options = parser.parse_args()
    try:
        prepare(_say)
    except UserError as error:
        parser.error(str(error))
    with (
        signals_as_exit(),  # or an ended script would leave its window and its screen behind
        tempfile.TemporaryDirectory(prefix="mc-nested-view-") as temporary,
        open_display() as env,
    ):
        folder = Path(temporary)
        run, profile = folder / "run", folder / "profile.toml"
        with open_rehearsal(env, folder, "--fps", "60") as window:
            mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, env=env)
            _draw_report(report_path(profile), options.folder / "report.png")
            live = ("--backend", "live", "--profile", str(profile), "--preset", "live", "--scenario", "diamond")
            command = [sys.executable, "-m", "mc_nested.cli", "train", *live, "--out", str(run)]
            with running(command, env={**env, "PYTHONPATH": str(ROOT)}, log=folder / "train.log") as training:
                time.sleep(options.seconds)
                (options.folder / "view.svg").write_text(asyncio.run(_screen(run)), encoding="utf-8")
                training.send_signal(signal.SIGINT)
                training.wait(ENDS_S)
    return 0


async def _screen(run: Path) -> str:
    """The view of a run, drawn with the reader's own font: nothing is fetched."""
    app = ViewApp(run)
    async with app.run_test(size=SIZE) as pilot:
        await pilot.pause(1.0)
        svg = app.export_screenshot(title="mc-nested train --view")
    return WEB_FONT.sub("", svg).replace("Fira Code", "monospace")


def _draw_report(report: Path, picture: Path) -> None:
    browser = shutil.which("chromium")
    if browser is None:
        _say("draw_view: no chromium here, so no report.png is drawn")
        return
    command = [browser, "--headless", "--hide-scrollbars", f"--window-size={REPORT_SIZE}"]
    command += ["--no-sandbox"] if os.geteuid() == 0 else []
    subprocess.run([*command, f"--screenshot={picture.resolve()}", report.resolve().as_uri()], check=True)  # noqa: S603
    with Image.open(picture) as page:
        part = page.crop(REPORT_PART)
    part.save(picture)


def _say(line: str) -> None:
    print(line, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
