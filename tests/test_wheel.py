"""A built wheel, installed alone in a separate environment, elsewhere: it trains, reads and rehearses."""

import json
import os
import shutil
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import NoReturn

import pytest

from scripts import environment
from scripts.window_display import running

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ("mc_nested", "sim", "calibration")

BIN = "Scripts" if sys.platform == "win32" else "bin"

PLACES = "import mc_nested, sim, calibration; print(*mc_nested.__path__, *sim.__path__, *calibration.__path__)"

READS_ALL = """
from importlib import resources
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.studies import ablation
from mc_nested.studies.benchmark import baseline
from mc_nested.studies.study import StudyOptions
from mc_nested.studies.sweep import varied
from mc_nested.learn.preset import load_preset, shipped_presets
from sim.client.drawing.letters import drawn_atlas

scenarios = [load_scenario(name) for name in shipped_scenarios()]
presets = {name: load_preset(name) for name in shipped_presets()}
print(len(scenarios), sorted(presets), len(varied(presets["paper"], scenarios[:1])) > 20)
print("<html" in (resources.files("calibration.report") / "page.html.jinja").read_text("utf-8"))
parts = ablation.arms(StudyOptions(trials=1, scenarios=scenarios[:1]))
print(len(parts) > 5, baseline().episodes, drawn_atlas().shape)
"""
"""Reads every file beside the code that a verb can need."""

DRAWS = """
import cv2, sys
from sim.client.client import VirtualClient
from sim.client.drawing.letters import drawn_atlas

client = VirtualClient(pitch=65.0)
client.clock.sleep(0.3)
cv2.imwrite(sys.argv[1], client.display.grab())
cv2.imwrite(sys.argv[2], drawn_atlas())
"""
"""Draws the virtual client's screen and its font."""

SOON_S = 60.0
"""A window opens, and a program ends, within this."""


class Installed:
    """An environment with the wheel, and a folder to work in; neither knows the sources."""

    def __init__(self, environment_folder: Path, folder: Path) -> None:
        self.bin = environment_folder / BIN
        self.folder = folder
        hidden = ("PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV", "MC_NESTED_COMPLETE")
        kept = {name: value for name, value in os.environ.items() if name not in hidden}
        self.env = {**kept, "HOME": str(folder), "XDG_CONFIG_HOME": str(folder), "XDG_DATA_HOME": str(folder)}

    def python(self, code: str, *words: str) -> str:
        """Return what the code prints."""
        return self._done([str(self.bin / "python"), "-c", code, *words])

    def mc_nested(self, *words: str) -> str:
        """Return what the command prints."""
        return self._done([str(self.bin / "mc-nested"), *words])

    def _done(self, command: list[str]) -> str:
        done = subprocess.run(
            command, cwd=self.folder, env=self.env, capture_output=True, text=True, check=False, timeout=600
        )
        assert done.returncode == 0, done.stderr or done.stdout
        return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", str(ROOT), "--no-deps", "--wheel-dir", str(folder)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        missing(f"no wheel could be built: {done.stderr[-500:]}")
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Installed]:
    """Return the wheel with its dependencies, of the versions in constraints.txt.

    It is removed at the end, since it is large.
    """
    folder = tmp_path_factory.mktemp("installed")
    subprocess.run([sys.executable, "-m", "venv", str(folder / "venv")], check=True)
    try:
        # What is never imported needn't be compiled: that takes as long as unpacking.
        environment.install(folder / "venv" / BIN / "python", ["rehearse"], ["--no-compile", str(wheel)])
    except SystemExit as failed:
        missing(str(failed))
    (folder / "work").mkdir()
    yield Installed(folder / "venv", folder / "work")
    shutil.rmtree(folder / "venv")


def missing(why: str) -> NoReturn:
    """Skip the test on a machine that can't install anything; with CI set, fail."""
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)


@pytest.mark.slow
def test_every_file_of_the_packages_is_in_the_wheel(wheel: Path) -> None:
    inside = set(zipfile.ZipFile(wheel).namelist())
    files = (path.relative_to(ROOT).as_posix() for package in PACKAGES for path in (ROOT / package).rglob("*.*"))
    assert [name for name in files if "__pycache__" not in name and name not in inside] == []
    assert {f"{package}/py.typed" for package in PACKAGES} < inside
    notes = f"{wheel.name.removesuffix('-py3-none-any.whl')}.dist-info"
    assert {name.split("/")[0] for name in inside} == {*PACKAGES, notes}


@pytest.mark.slow
def test_the_installed_wheel_reads_all_its_files(installed: Installed) -> None:
    where = installed.python(PLACES)
    assert all(Path(path).is_relative_to(installed.bin.parent) for path in where.split())
    assert installed.python(READS_ALL).splitlines() == [
        "7 ['any-design', 'image', 'model-based', 'paper', 'tuned'] True",
        "True",
        "True 500 (128, 128, 4)",
    ]


@pytest.mark.slow
def test_the_installed_command_lists_trains_and_plays(installed: Installed) -> None:
    assert "optimum    21" in installed.mc_nested("scenarios", "line")
    printed = json.loads(installed.mc_nested("train", "--episodes", "20", "--json", "--quiet"))
    assert printed["episodes_done"] == [20]
    assert (installed.folder / printed["folder"] / "curve.png").exists()
    score = printed["final_scores"][0]
    assert f"score {score:g} of 21" in installed.mc_nested("play", printed["folder"], "--quiet")
    assert json.loads(installed.mc_nested("runs", "--json"))["runs"][0]["state"] == "finished"


@pytest.mark.slow
def test_the_installed_command_reads_a_picture(installed: Installed) -> None:
    installed.python(DRAWS, "screen.png", "font.png")
    (line,) = installed.mc_nested("read", "screen.png", "--font", "font.png", "--json").splitlines()
    found = json.loads(line)
    assert found["problem"] is None
    assert found["pitch"] == 65.0


@pytest.mark.slow  # and not of the windows: it opens one and closes it, and plays nothing
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the display is Xvfb's")
def test_the_installed_command_rehearses(installed: Installed, display: dict[str, str]) -> None:
    from Xlib import X  # Linux alone has it
    from Xlib.display import Display
    from Xlib.protocol import event

    truth, log = installed.folder / "truth.json", installed.folder / "log"
    command = [str(installed.bin / "mc-nested"), "rehearse", "--truth", str(truth)]
    env = {**installed.env, "DISPLAY": display["DISPLAY"]}
    with running(command, env=env, log=log) as process:
        end = time.monotonic() + SOON_S
        while not truth.exists():
            assert process.poll() is None, log.read_text()
            assert time.monotonic() < end
            time.sleep(0.1)
        desktop = Display(display["DISPLAY"])
        window = desktop.get_input_focus().focus
        protocols, delete = (desktop.intern_atom(name) for name in ("WM_PROTOCOLS", "WM_DELETE_WINDOW"))
        data = (32, [delete, X.CurrentTime, 0, 0, 0])
        window.send_event(event.ClientMessage(window=window, client_type=protocols, data=data))
        desktop.sync()
        assert process.wait(SOON_S) == 0, log.read_text()
        desktop.close()
    assert "Close the window to end." in log.read_text()
