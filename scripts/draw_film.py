"""Films scripts/build.gif, README's film of a build: a policy learnt in the simulator builds in the rehearsal window.

    python scripts/draw_film.py [OUT.gif|OUT.mp4] [--scenario zigzag]

It calibrates from nothing, which takes two minutes. Linux, on a display of its own.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.errors import UserError
from mc_nested.live.input.signals import signals_as_exit
from scripts.benches.rehearsal import prepare
from scripts.rehearsal_window import mc_nested, open_rehearsal
from scripts.window_display import open_display

WINDOW = ("--size", "1344x960", "--gui-scale", "1", "--fps", "60")
"""At this scale the chat, which stays grey in a film, covers little."""


def main() -> int:
    """Learn, calibrate, and film; the exit code."""
    parser = argparse.ArgumentParser(description="Films a build in the rehearsal window.")
    parser.add_argument("out", nargs="?", type=Path, default=Path(__file__).with_name("build.gif"))
    parser.add_argument("--scenario", default="zigzag")
    options = parser.parse_args()
    try:
        prepare(lambda line: print(line, file=sys.stderr))
    except UserError as error:
        parser.error(str(error))
    with (
        signals_as_exit(),  # or an ended film would leave its window and its screen behind
        tempfile.TemporaryDirectory(prefix="mc-nested-film-") as temporary,
        open_display() as env,
    ):
        folder = Path(temporary)
        run, profile = folder / "run", folder / "profile.toml"
        learnt = ("--scenario", options.scenario, "--preset", "live", "--stop-at-optimum", "--out", run)
        mc_nested("train", *learnt, env=env)
        with open_rehearsal(env, folder, *WINDOW) as window:
            mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", window.font, env=env)
            live = ("--backend", "live", "--profile", profile)
            print(mc_nested("play", run, *live, "--video", options.out.resolve(), env=env))
    return 0


if __name__ == "__main__":
    sys.exit(main())
