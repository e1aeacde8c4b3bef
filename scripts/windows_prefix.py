"""Wine's prefix, the folder that holds its Windows: made once in .windows/prefix. Standard library only."""

import shutil
import subprocess
from pathlib import Path

from scripts.standin_parts import Say
from scripts.window_display import open_display
from scripts.windows_parts import WINE, WINESERVER
from scripts.windows_session import environment, open_wineserver, run_wine

WINDOWS = "win10"
"""The version that programs are told: Wine 8's own default is Windows 7, which Python 3.12 refuses."""


def make_prefix(cache: Path, say: Say) -> None:
    """Make the prefix, unless this Wine has made it already.

    Raises:
        SessionError: Wine failed; its log is named.
    """
    prefix, stamp, home, logs = cache / "prefix", cache / "prefix.made", cache / "home", cache / "logs"
    wanted = f"{_wine_version()} {WINDOWS}"
    if stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return
    say("making Wine's prefix, 700 MB")
    stamp.unlink(missing_ok=True)
    shutil.rmtree(prefix, ignore_errors=True)
    home.mkdir(exist_ok=True)
    with open_display() as display:
        env = environment(cache, display["DISPLAY"], home)
        with open_wineserver(env, logs / "wineserver.log"):
            run_wine(["wineboot", "--init"], env, logs / "wine.log")
            run_wine(["winecfg", "-v", WINDOWS], env, logs / "wine.log")
    stamp.write_text(wanted, encoding="utf-8")


def _wine_version() -> str:
    asked = [WINE.required(), "--version"]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=60, check=False)  # noqa: S603 - fixed
    return f"{answer.stdout.strip()} {WINESERVER.required()}"
