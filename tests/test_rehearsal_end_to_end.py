"""From a bare profile to the pixels of a real window and back: the rehearsal's, checked by what its client says.

Beside one other window at most: they are drawn in real time.
"""

import json
import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows of an X server", allow_module_level=True)

from Xlib import X
from Xlib.display import Display
from Xlib.ext import xtest
from Xlib.protocol import event

from mc_nested.arena.scenario_file import draw_grid, load_scenario
from mc_nested.cli.interrupt import INTERRUPTED
from mc_nested.design_files.load import load_any_scenario
from mc_nested.live.model.reading import Block
from mc_nested.live.profile.store import load_profile
from mc_nested.live.recording.recording_file import facts_of
from scripts.benches.rehearsal import CONDITIONS, USUAL, Condition, play
from scripts.programs import ROOT
from scripts.rehearsal_window import RehearsalWindow, mc_nested, open_rehearsal
from scripts.window_display import WITH_THIS_PROCESS, open_display
from sim.client.game.world import AIR
from tests.design_files.written import HUT, sponge
from tests.made_once import made_once

pytestmark = pytest.mark.window

F12, F9, S, A = 96, 75, 39, 38
"""A keycode of an X server: 8 more than Linux's own."""

LONGEST_CALIBRATION_S = 180.0
"""On a machine that may be busy; `bench.py rehearsal` asks for 100."""
LONGEST_TRY_S = 600.0
"""What a volunteer is promised."""
ACTIONS = 20
CURRENT = "26.3"
"""What people play: its options are at their defaults, and the debug text lies over its menus, smaller than they."""
SOON_S = 60.0


def calibrate(rehearsal: RehearsalWindow, profile: Path) -> None:
    mc_nested("calibrate", "all", "--yes", "--profile", profile, "--font", rehearsal.font, env=rehearsal.env)


@dataclass(frozen=True)
class Calibrated:
    """A profile that `calibrate all` made from nothing, and the seconds that it took."""

    profile: Path
    seconds: float


@pytest.fixture(scope="module")
def calibrated(tmp_path_factory: pytest.TempPathFactory, window_programs: None) -> Calibrated:  # noqa: ARG001
    """Return a profile calibrated in a window at 60 frames a second, for all of xdist's processes."""

    def make(folder: Path) -> None:
        with open_display() as env, open_rehearsal(env, folder) as rehearsal:
            began = time.monotonic()
            calibrate(rehearsal, folder / "profile.toml")
            (folder / "seconds").write_text(str(time.monotonic() - began))

    folder = made_once("calibrated", make, tmp_path_factory)
    return Calibrated(folder / "profile.toml", float((folder / "seconds").read_text()))


@pytest.fixture
def profile(calibrated: Calibrated) -> Path:
    return calibrated.profile


def test_calibrating_from_nothing_takes_less_than_three_minutes(calibrated: Calibrated) -> None:
    assert calibrated.seconds < LONGEST_CALIBRATION_S


@contextmanager
def in_its_arena(profile: Path, folder: Path, condition: Condition = USUAL) -> Iterator[RehearsalWindow]:
    """Yield a rehearsal under that condition. Its world is new: the arena is only where the profile says."""
    with (
        open_display(layout=condition.layout, has_window_manager=condition.has_window_manager) as env,
        open_rehearsal(env, folder, "--fps", str(condition.fps)) as rehearsal,
    ):
        assert load_profile(str(profile)).arena is not None
        yield rehearsal


@pytest.mark.parametrize(("design", "preset"), [("line", "paper"), ("diamond", "tuned")])
def test_a_policy_learnt_in_the_simulator_builds_its_design(
    design: str, preset: str, profile: Path, tmp_path: Path
) -> None:
    run, scenario = tmp_path / "run", load_scenario(design)
    with in_its_arena(profile, tmp_path) as rehearsal:
        words = ("--scenario", design, "--preset", preset, "--stop-at-optimum", "--out", run)
        mc_nested("train", *words, env=rehearsal.env)
        recording = tmp_path / "recording"
        live = ("--backend", "live", "--profile", profile, "--record", recording)
        printed = mc_nested("play", run, *live, env=rehearsal.env)
        assert f"score {scenario.optimum:g} of {scenario.optimum:g}" in printed
        arena = load_profile(str(profile)).marked_arena()
        material = printed.split(", in ")[1].split(",")[0]
        block = scenario.materials[scenario.material_index(material)].block
        replayed = json.loads(mc_nested("replay", recording, "--json", env=rehearsal.env))
        assert (replayed["actions"] > 0, replayed["differences"]) == (True, [])
        facts = facts_of(recording)
        assert (facts["monitors"], facts["window"].split(" at ")[0]) == ("1400x1000 at 0 0", facts["size"])
        assert replayed["followed"] == replayed["actions"]
        assert rehearsal.truth.standing(arena) == {arena.block_of(cell): block for cell in scenario.design}
        assert rehearsal.truth.keys_left_down() == []


@pytest.mark.usefixtures("window_programs")
def test_a_current_version_is_tried_by_a_volunteer_and_all_is_put_back(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with open_display() as env, open_rehearsal(env, tmp_path, "--version", CURRENT) as rehearsal:
        before, began = without_air(rehearsal.truth.built()), time.monotonic()
        said = mc_nested("try-it", "--yes", "--font", rehearsal.font, "--out", out, env=rehearsal.env)
        assert time.monotonic() - began < LONGEST_TRY_S
        assert f"please send {out / 'out.zip'}" in said
        assert without_air(rehearsal.truth.built()) == before
        assert rehearsal.truth.keys_left_down() == []
        with zipfile.ZipFile(out / "out.zip") as file:
            file.extractall(tmp_path / "sent")
        for name in ("1-calibration", "2-actions", "3-line", "4-undo"):
            recording = tmp_path / "sent" / f"{name}.mcap"
            words = ("replay", recording, "--font", rehearsal.font, "--json")
            assert json.loads(mc_nested(*words, env=rehearsal.env))["differences"] == []


@pytest.mark.usefixtures("window_programs")
def test_a_current_version_has_the_line_learnt_and_built_in_its_window(tmp_path: Path) -> None:
    profile, run, line = tmp_path / "profile.toml", tmp_path / "run", load_scenario("line")
    with open_display() as env, open_rehearsal(env, tmp_path, "--version", CURRENT) as rehearsal:
        calibrate(rehearsal, profile)
        words = ("--scenario", "line", "--preset", "model-based", "--stop-at-optimum", "--out", run)
        mc_nested("train", *words, "--backend", "live", "--profile", profile, env=rehearsal.env, timeout_s=1200)
        assert json.loads((run / "summary.json").read_text())["final_scores"] == [line.optimum]
        # The training ends with the greedy episode that reached the optimum, and resets nothing after it.
        arena = load_profile(str(profile)).marked_arena()
        best = max(line.materials, key=lambda material: material.p)
        assert rehearsal.truth.standing(arena) == {arena.block_of(cell): best.block for cell in line.design}
        assert rehearsal.truth.keys_left_down() == []


@pytest.mark.usefixtures("window_programs")
def test_a_layer_of_a_schematic_is_built_without_learning_and_the_old_blocks_are_restored(tmp_path: Path) -> None:
    profile, hut = tmp_path / "profile.toml", tmp_path / "hut.schem"
    hut.write_bytes(sponge(HUT))
    with open_display() as env, open_rehearsal(env, tmp_path) as rehearsal:
        before = without_air(rehearsal.truth.built())
        calibrate(rehearsal, profile)
        arena, scenario = load_profile(str(profile)).marked_arena(), load_any_scenario(hut, 0).scenario
        words = ("--layer", "0", "--material", "wood", "--backend", "live", "--profile", profile)
        printed = mc_nested("build", hut, *words, env=rehearsal.env)
        assert "built 11 of 11 blocks, of wood" in printed
        assert f"mc-nested calibrate arena --undo --profile {profile}" in printed
        assert rehearsal.truth.standing(arena) == {arena.block_of(cell): "oak_planks" for cell in scenario.design}
        mc_nested("calibrate", "arena", "--undo", "--profile", profile, env=rehearsal.env)
        assert without_air(rehearsal.truth.built()) == before
        assert rehearsal.truth.keys_left_down() == []


def without_air(blocks: dict[Block, str]) -> dict[Block, str]:
    return {at: name for at, name in blocks.items() if name != AIR}


@pytest.mark.parametrize("condition", [each for each in CONDITIONS if each != USUAL], ids=lambda each: each.name)
def test_no_cell_or_block_is_wrong_at_other_frame_rates_layouts_and_window_managers(
    condition: Condition, profile: Path, tmp_path: Path
) -> None:
    with in_its_arena(profile, tmp_path, condition) as rehearsal:
        figures = play(profile, rehearsal.truth_file, ACTIONS, 0, rehearsal.env)
    assert (figures["actions"], figures["wrong_cells"], figures["wrong_blocks"]) == (ACTIONS, 0, 0)
    assert figures["failed_actions"] <= ACTIONS // 4


def soon(is_so: Callable[[], bool]) -> bool:
    """Return whether ``is_so`` returns True soon."""
    end = time.monotonic() + SOON_S
    while not is_so():
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


class Training:
    """A live training in a process of its own, and the desktop that it runs on."""

    def __init__(self, rehearsal: RehearsalWindow, profile: Path, folder: Path, display: Display) -> None:
        self.rehearsal, self.display, self.run = rehearsal, display, folder / "run"
        tiny = folder / "tiny.toml"
        grid = draw_grid(frozenset({(7, 13), (7, 12), (7, 11)}), 15)
        tiny.write_text(
            f'name = "tiny"\nstart = [7, 13]\nstep_limit = 8\ndesign = """\n{grid}"""\n'
            '[[materials]]\nname = "stone"\np = 0\nblock = "stone"\n'
        )
        self.words = ["train", "--scenario", str(tiny), "--preset", "model-based", "--episodes", "12"]
        self.words += ["--out", str(self.run), "--backend", "live", "--profile", str(profile)]

    def start(self, *words: str) -> "subprocess.Popen[str]":
        command = [*WITH_THIS_PROCESS, sys.executable, "-m", "mc_nested.cli", *(words or self.words)]
        env = {**self.rehearsal.env, "PYTHONPATH": str(ROOT)}
        return subprocess.Popen(command, env=env, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def is_moving(self) -> bool:
        """Return whether the agent holds a key in the world."""
        return bool(self.rehearsal.truth.now()["keys_down"])

    def is_resting(self) -> bool:
        return not self.is_moving()


@pytest.fixture
def training(profile: Path, tmp_path: Path) -> Iterator[Training]:
    with in_its_arena(profile, tmp_path) as rehearsal:
        display = Display(rehearsal.env["DISPLAY"])
        try:
            yield Training(rehearsal, profile, tmp_path, display)
        finally:
            display.close()


def test_the_panic_key_stops_a_live_training_which_goes_on_later(training: Training) -> None:
    process = training.start()
    assert soon(training.is_moving)
    for kind in (X.KeyPress, X.KeyRelease):
        xtest.fake_input(training.display, kind, F12)
    training.display.sync()
    _, said = process.communicate(timeout=SOON_S)
    assert process.returncode != 0
    assert "the panic key was pressed" in said
    assert soon(training.is_resting)
    resumed = training.start("train", "--resume", str(training.run))
    _, said = resumed.communicate(timeout=300)
    assert resumed.returncode == 0, said
    assert json.loads((training.run / "summary.json").read_text())["episodes_done"] == [12]


def test_a_player_takes_over_a_live_training_and_gives_it_back(training: Training) -> None:
    truth, hands = training.rehearsal.truth, training.display

    def tap(key: int, held_s: float = 0.05) -> None:
        for kind in (X.KeyPress, X.KeyRelease):
            xtest.fake_input(hands, kind, key)
            hands.sync()
            time.sleep(held_s)

    words = training.words
    words[words.index("--scenario") + 1] = "diamond"  # an episode long enough to be in it
    process = training.start(*words)
    assert soon(lambda: not {"stone", "oak_planks"}.isdisjoint(truth.built().values())), "an episode is under way"
    tap(F9, 0.25)
    before, end = truth.now()["feet"], time.monotonic() + 2.0
    while time.monotonic() < end:
        assert training.is_resting(), "nothing of the agent's is pressed"
        time.sleep(0.02)
    tap(S, 0.25)
    tap(A, 0.25)
    assert soon(lambda: truth.now()["feet"] != before)
    assert process.poll() is None
    tap(F9)
    assert soon(training.is_moving)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=SOON_S)
    assert process.returncode == INTERRUPTED, said
    assert "To take over, and to give back, press f9." in said
    assert truth.keys_left_down() == []


def test_a_live_training_survives_another_window_in_front_and_a_new_window_size(training: Training) -> None:
    process = training.start()
    assert soon(training.is_moving)
    root, game = training.display.screen().root, training.display.get_input_focus().focus
    thief = root.create_window(1200, 800, 100, 100, 0, X.CopyFromParent)
    thief.map()
    training.display.sync()
    thief.set_input_focus(X.RevertToParent, X.CurrentTime)
    training.display.sync()
    assert soon(lambda: not training.rehearsal.truth.now()["is_in_front"])
    assert soon(training.is_resting)
    time.sleep(0.3)
    thief.destroy()
    game.set_input_focus(X.RevertToParent, X.CurrentTime)
    training.display.sync()
    assert soon(training.is_moving)
    game.configure(width=1000, height=600)
    training.display.sync()
    _, said = process.communicate(timeout=300)
    assert process.returncode == 0, said
    assert json.loads((training.run / "summary.json").read_text())["episodes_done"] == [12]


def test_closing_the_window_ends_the_training_with_a_message(training: Training) -> None:
    process = training.start()
    assert soon(training.is_moving)
    window = training.display.get_input_focus().focus
    protocols, delete = (training.display.intern_atom(name) for name in ("WM_PROTOCOLS", "WM_DELETE_WINDOW"))
    data = (32, [delete, X.CurrentTime, 0, 0, 0])
    window.send_event(event.ClientMessage(window=window, client_type=protocols, data=data))
    training.display.sync()
    _, said = process.communicate(timeout=SOON_S)
    assert process.returncode == 2, said
    assert "has closed: start the game again" in said, said
    assert "Traceback" not in said
