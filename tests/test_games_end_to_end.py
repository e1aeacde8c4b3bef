"""A real window's game, served to a learner: both ends in processes of their own, over a real scheduler on loopback.

Beside one other window at most: they are drawn in real time.
"""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows of an X server", allow_module_level=True)

from Xlib import X
from Xlib.display import Display
from Xlib.ext import xtest

from mc_nested.arena.scenario import Scenario
from scripts.programs import ROOT
from scripts.rehearsal_window import RehearsalWindow, mc_nested, open_rehearsal
from scripts.window_display import WITH_THIS_PROCESS, open_display
from tests.learn.made_experiments import DOT, MATERIALS, scenario_text
from tests.workers.cluster.dask_programs import scheduler

pytestmark = pytest.mark.window

F12 = 96
"""The panic key's keycode at an X server: 8 more than Linux's own."""

PANIC = "the panic key was pressed: every key is up, start again when you like"
WALKING = {"w", "a", "s", "d"}
SOON_S = 60.0
SIZE = "1000x720"
"""Of the window: in a smaller one the chat covers what is read, and a reset waits until it is gone."""

WIDE = Scenario("wide", frozenset({(7, 13)}), (7, 13), 4, MATERIALS, 16)
"""Wider by a cell than the arena that was calibrated."""


@dataclass(frozen=True)
class Window:
    """A rehearsal that is open, a connection to its display, a profile of it, and a scheduler's address."""

    rehearsal: RehearsalWindow
    display: Display
    profile: Path
    url: str

    def is_walking(self) -> bool:
        """Return whether the agent takes a step: an episode has begun, and its reset is over."""
        now = self.rehearsal.truth.now()
        keys = set(now["keys_down"])
        # With F3 the key D clears the chat, in a reset.
        return now["screen"] == "world" and not WALKING.isdisjoint(keys) and "f3" not in keys

    def press(self, keycode: int) -> None:
        """Press a key as a keyboard does."""
        for kind in (X.KeyPress, X.KeyRelease):
            xtest.fake_input(self.display, kind, keycode)
        self.display.sync()

    @contextmanager
    def behind_another(self) -> Iterator[None]:
        """Give another window the focus, while the block runs."""
        game = self.display.get_input_focus().focus
        other = self.display.screen().root.create_window(1200, 800, 100, 100, 0, X.CopyFromParent)
        other.map()
        self.display.sync()
        other.set_input_focus(X.RevertToParent, X.CurrentTime)
        self.display.sync()
        try:
            yield
        finally:
            other.destroy()
            game.set_input_focus(X.RevertToParent, X.CurrentTime)
            self.display.sync()


def wait_until(is_so: Callable[[], bool], otherwise: Callable[[], object] = lambda: "it stays as it is") -> None:
    """Wait until ``is_so`` returns True; fail where that takes too long."""
    end = time.monotonic() + SOON_S
    while not is_so():
        assert time.monotonic() < end, otherwise()
        time.sleep(0.02)


class Program:
    """One end in its own process, and its output."""

    def __init__(self, words: list[str], folder: Path, env: dict[str, str]) -> None:
        self._log = folder / f"{words[1].strip('-')}.log"
        command = [*WITH_THIS_PROCESS, sys.executable, "-m", "mc_nested.cli", *words]
        env = {**env, "PYTHONPATH": str(ROOT)}
        with self._log.open("wb") as log:
            self.process = subprocess.Popen(command, cwd=folder, env=env, stdout=log, stderr=log)

    def lines(self) -> list[str]:
        """Return every line of its output."""
        return self._log.read_text("utf-8").splitlines()

    def says(self, *words: str) -> None:
        """Wait until a line holds all of these."""
        wait_until(lambda: any(all(word in line for word in words) for line in self.lines()), self.lines)

    def end(self) -> int:
        """Press Ctrl+C, and return the exit code."""
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(SOON_S)


@pytest.fixture(scope="module")
def window(tmp_path_factory: pytest.TempPathFactory, window_programs: None) -> Iterator[Window]:  # noqa: ARG001
    """Open a window for all tests.

    Its profile has a font and an arena alone: a whole calibration takes a minute longer.
    """
    folder = tmp_path_factory.mktemp("window")
    with open_display() as env, open_rehearsal(env, folder, "--size", SIZE) as rehearsal, scheduler(folder) as url:
        profile = folder / "profile.toml"
        mc_nested("calibrate", "arena", "--yes", "--profile", profile, "--font", rehearsal.font, env=rehearsal.env)
        display = Display(env["DISPLAY"])
        try:
            yield Window(rehearsal, display, profile, url)
        finally:
            display.close()


@dataclass(frozen=True)
class Ends:
    """Starts both ends in a folder."""

    window: Window
    folder: Path
    started: list[Program] = field(default_factory=list)

    @property
    def run(self) -> Path:
        """The folder of the training."""
        return self.folder / "run"

    def game(self, profile: str | Path | None = None) -> Program:
        """Return the window's game, served."""
        words = ["train", "serve", "--scheduler", self.window.url, "--name", "pc", "--backend", "live"]
        return self._program([*words, "--profile", str(profile or self.window.profile)])

    def learner(self, scenario: Scenario = DOT) -> Program:
        """Return a training in whatever game is served."""
        (self.folder / "scenario.toml").write_text(scenario_text(scenario), "utf-8")
        words = ["train", "--scenario", "scenario.toml", "--preset", "model-based", "--backend", "live", "--seed", "3"]
        return self._program([*words, "--games", self.window.url, "--out", str(self.run)])

    def counted_and_lost(self) -> tuple[int, int]:
        """Return a saved training's episodes: those that it learnt from, with evaluations, and those that it lost."""
        tables = (self.run / "episodes.csv", self.run / "evaluations.csv")
        summary = json.loads((self.run / "summary.json").read_text("utf-8"))
        rows = sum(len(table.read_text("utf-8").splitlines()) - 1 for table in tables)
        return rows, summary["live"]["spoiled_episodes"]

    def _program(self, words: list[str]) -> Program:
        self.started.append(Program(words, self.folder, self.window.rehearsal.env))
        return self.started[-1]


@pytest.fixture
def ends(window: Window, tmp_path: Path) -> Iterator[Ends]:
    both = Ends(window, tmp_path)
    try:
        yield both
        assert not any("Traceback" in line for program in both.started for line in program.lines())
        assert window.rehearsal.truth.keys_left_down() == []
    finally:
        for program in both.started:
            program.process.kill()
            program.process.wait()


def played(game: Program) -> int:
    """Return how many whole episodes the game says it has played."""
    return sum(": score " in line for line in game.lines())


def stops_and_saves(learner: Program) -> bool:
    """Return whether the learner has gone on until now, and ends well at Ctrl+C."""
    return learner.process.poll() is None and learner.end() == 130 and "stopped and saved" in learner.lines()[-1]


def test_a_game_behind_another_window_is_paused_and_loses_its_episode(window: Window, ends: Ends) -> None:
    game, learner = ends.game(), ends.learner()
    game.says("episode 1: score")
    wait_until(window.is_walking)
    with window.behind_another():
        game.says("the episode was lost")
        learner.says("pc: ", "its episode is lost")
        game.says("paused: switch to the game to let it go on")
        assert window.rehearsal.truth.keys_left_down() == []
        before = played(game)
    game.says("goes on")
    game.says(f"episode {before + 1}: score")
    assert game.end() == 130
    assert game.lines()[-1] == "mc-nested: stopped: no key is held, and the learner goes on without this game"
    assert window.rehearsal.truth.keys_left_down() == []
    learner.says("pc is gone")
    assert stops_and_saves(learner)
    counted, lost = ends.counted_and_lost()
    assert counted == played(game) > before
    assert lost in (1, 2)  # the last one where Ctrl+C came in the middle of it


@pytest.mark.parametrize("paused", [False, True], ids=["playing", "paused"])
def test_the_panic_key_ends_the_game_and_its_learner_waits_for_another(
    paused: bool, window: Window, ends: Ends
) -> None:
    game, learner = ends.game(), ends.learner()
    game.says("episode 1: score")
    wait_until(window.is_walking)
    with window.behind_another() if paused else ExitStack():
        if paused:
            game.says("paused: switch to the game to let it go on")
        window.press(F12)
        assert game.process.wait(SOON_S) == 2
        assert window.rehearsal.truth.keys_left_down() == []
    assert game.lines()[-1] == f"mc-nested: {PANIC}"
    learner.says(f"pc: {PANIC}" if paused else f"pc: {PANIC}, its episode is lost")
    learner.says("pc is gone")
    assert stops_and_saves(learner)
    assert "waiting for a game (mc-nested train serve), 1 episode lost" in learner.lines()[-2]
    assert ends.counted_and_lost() == (played(game), 1)


def test_a_scenario_too_large_for_the_arena_is_refused_in_one_line_at_both_ends(window: Window, ends: Ends) -> None:
    game, learner = ends.game(), ends.learner(WIDE)
    assert (game.process.wait(SOON_S), learner.process.wait(SOON_S)) == (2, 2)
    needs = "scenario wide needs 16 x 16 cells, and the profile's arena has 15 x 15"
    says = f"{needs}: run mc-nested calibrate arena --size 16 --profile {window.profile}"
    assert game.lines() == [f"pc has joined {window.url}", f"mc-nested: {says}"]
    saved = f"saved: go on with mc-nested train --resume {ends.run}"
    assert learner.lines()[1:] == ["pc has joined", f"mc-nested: pc can't play: {says}; {saved}"]


def test_an_unknown_profile_is_refused_in_one_line(ends: Ends) -> None:
    game = ends.game("nobody")
    assert game.process.wait(SOON_S) == 2
    (line,) = game.lines()
    assert line.startswith("mc-nested: no profile 'nobody': looked for ")
