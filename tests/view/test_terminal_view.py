"""``--view`` in a real terminal: its screen, its keys, and a terminal that is restored afterwards."""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, cast

import pytest

from mc_nested.cli.view import Viewed, viewed
from mc_nested.view.board import Board
from mc_nested.view.files import status_now
from mc_nested.view.publisher import Publisher
from tests.cli.running import run

if not sys.platform.startswith("linux"):
    pytest.skip("Linux's pseudo-terminals and processes", allow_module_level=True)

from tests.cli.terminal import Terminal

if TYPE_CHECKING:
    from mc_nested.view.terminal_view import TerminalView

TRAINING = ("train", "--preset", "model-based", "--scenario", "zigzag", "--out", "run")
LONG = (*TRAINING, "--episodes", "100000")
"""It goes on until it is stopped; 200 episodes end after seconds."""
SHORT = (*TRAINING, "--episodes", "3")

Opens = Callable[..., "Terminal"]


@pytest.fixture
def opened(tmp_path: Path) -> Iterator[Opens]:
    terminals: list[Terminal] = []

    def opens(*words: str, columns: int = 100, lines: int = 30, hangs_up: bool = False) -> Terminal:
        terminals.append(Terminal(words, tmp_path, columns, lines, hangs_up=hangs_up))
        return terminals[-1]

    yield opens
    for terminal in terminals:
        terminal.close()


def viewed_training(opened: Opens) -> Terminal:
    """Return a long training in a terminal, once its view shows that it trains."""
    terminal = opened(*LONG, "--view")
    terminal.until("trains in the simulator")
    return terminal


def paused_by_another(opened: Opens) -> tuple[Terminal, Terminal]:
    """Return a long training in a terminal, and a view of it in another one, which has paused it."""
    training = opened(*LONG)
    training.until("updates/s")
    view = opened("view", "run")
    view.until("zigzag, nested agent", training)
    view.press("p")
    view.until("paused; press p to go on", training)
    return training, view


def child_of(process: int) -> int:
    """Return the one child of a process: its view."""
    (child,) = Path(f"/proc/{process}/task/{process}/children").read_text().split()
    return int(child)


@pytest.mark.slow
def test_a_viewed_training_ends_like_one_without_a_view(opened: Opens, tmp_path: Path) -> None:
    terminal = opened(*SHORT, "--view")
    terminal.until("zigzag, nested agent, preset model-based, in the simulator")
    terminal.until("next:")

    assert terminal.end() == 0
    assert terminal.mode == terminal.before
    assert run("play", tmp_path / "run") == 0


@pytest.mark.slow
def test_a_viewed_training_is_paused_and_stopped_by_keys_and_can_be_resumed(opened: Opens, tmp_path: Path) -> None:
    terminal = viewed_training(opened)
    terminal.press("p")
    terminal.until("paused; press p to go on")
    terminal.press("s")
    terminal.until("stopped and saved: go on with mc-nested train --resume run")

    assert terminal.end() == 130
    assert terminal.mode == terminal.before
    assert (tmp_path / "run" / "checkpoint").is_dir()


@pytest.mark.slow
def test_ctrl_c_in_the_view_stops_the_run(opened: Opens) -> None:
    terminal = viewed_training(opened)
    terminal.press("\x03")
    terminal.until("stopped and saved")

    assert terminal.end() == 130


@pytest.mark.slow
def test_run_goes_on_with_plain_lines_after_its_view_is_closed(opened: Opens) -> None:
    terminal = viewed_training(opened)
    terminal.press("q")
    terminal.until("run:        run")
    assert terminal.process.poll() is None
    terminal.process.send_signal(signal.SIGINT)
    terminal.until("stopped and saved")

    assert terminal.end() == 130
    assert terminal.mode == terminal.before


@pytest.mark.slow
def test_run_goes_on_unpaused_if_its_view_is_killed(opened: Opens) -> None:
    terminal = viewed_training(opened)
    terminal.press("p")
    terminal.until("paused")
    os.kill(child_of(terminal.process.pid), signal.SIGKILL)
    terminal.until("run:        run")
    terminal.raw = b""
    terminal.until("episodes")  # it goes on
    assert terminal.mode == terminal.before
    terminal.process.send_signal(signal.SIGINT)

    assert terminal.end() == 130


@pytest.mark.slow
def test_the_view_of_a_run_that_is_killed_closes_by_itself(opened: Opens) -> None:
    terminal = viewed_training(opened)
    view = child_of(terminal.process.pid)
    terminal.process.kill()
    terminal.process.wait()

    terminal.until_gone(view)

    assert terminal.mode == terminal.before


@pytest.mark.slow
@pytest.mark.parametrize("view", [[], ["--view"]])
def test_a_training_whose_terminal_is_closed_is_saved(opened: Opens, tmp_path: Path, view: list[str]) -> None:
    terminal = opened(*LONG, *view, hangs_up=True)
    terminal.until("trains in the simulator" if view else "updates/s")

    assert terminal.hang_up() == 130
    assert (tmp_path / "run" / "summary.json").is_file()
    assert (tmp_path / "run" / "checkpoint").is_dir()


@pytest.mark.slow
def test_mistake_is_refused_in_one_line_with_a_view_too(opened: Opens, tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "file").write_text("")
    terminal = opened(*LONG, "--view")

    assert terminal.end() == 2
    assert terminal.text.strip().startswith("mc-nested: run: exists and is not empty")


@pytest.mark.slow
def test_play_and_build_can_be_viewed(opened: Opens, tmp_path: Path) -> None:
    assert run("train", "--preset", "model-based", "--episodes", "3", "--out", tmp_path / "run") == 0
    for words, title in ((("play", "run"), "play: line, trial 0"), (("build", "line"), "build: line")):
        terminal = opened(*words, "--view", columns=40, lines=24)
        terminal.until(title)
        assert terminal.end() == 0
        assert terminal.mode == terminal.before


@pytest.mark.slow
def test_another_terminal_views_a_run_resumes_it_and_stops_it(opened: Opens) -> None:
    training, view = paused_by_another(opened)
    view.press("p")
    view.until("trains in the simulator", training)
    view.press("\x03")
    assert view.end() == 0
    assert training.process.poll() is None  # Ctrl+C there closes the view alone
    view = opened("view", "run")
    view.until("zigzag, nested agent", training)
    view.press("s")
    training.until("stopped and saved")
    assert training.end() == 130
    view.until("stopped and saved: go on with")
    view.press("q")

    assert view.end() == 0


@pytest.mark.slow
def test_pause_ends_if_the_view_that_asked_for_it_is_killed(opened: Opens, tmp_path: Path) -> None:
    training, view = paused_by_another(opened)
    view.process.kill()
    end = time.monotonic() + 60
    while status_now(tmp_path / "run").paused:
        assert time.monotonic() < end, "it stays paused"
        training.read()
    training.process.send_signal(signal.SIGINT)

    assert training.end() == 130


class FakeView:
    """A view that is open until somebody closes it."""

    is_open = True


def test_a_question_is_asked_in_the_terminal_once_the_view_is_closed(tmp_path: Path) -> None:
    view, asked = FakeView(), []

    def confirm(question: str) -> bool:
        asked.append(question)
        return True

    with Publisher(Board("calibrate all", "a title"), tmp_path) as publisher:
        viewing = Viewed(publisher, cast("TerminalView", view))
        closing = threading.Timer(0.3, setattr, (view, "is_open", False))
        closing.start()
        assert viewing.ask("Clear it?", confirm)  # closed while it waits
        assert viewing.ask("And this?", confirm)  # closed before

    assert asked == ["Clear it?", "And this?"]


def test_a_view_that_can_not_be_opened_leaves_the_terminal_as_it_was(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise OSError(11, "Resource temporarily unavailable")

    monkeypatch.setattr("mc_nested.view.terminal_view._terminal_restorer", lambda: lambda: None)
    monkeypatch.setattr("mc_nested.cli.view.can_draw", lambda: True)
    monkeypatch.setattr("subprocess.Popen", refuse)
    streams = sys.stdout, sys.stderr

    with viewed(True, "play", "a title") as viewing:
        assert not viewing.is_shown
        print("it goes on")
        os.write(2, b"here, too\n")

    assert (sys.stdout, sys.stderr) == streams
    said = capfd.readouterr()
    assert said.out == "it goes on\n"
    assert said.err.splitlines() == [
        "no view, the run goes on without it: [Errno 11] Resource temporarily unavailable",
        "here, too",
    ]


def test_failed_start_leaves_no_folder_and_removes_no_file_of_the_users(tmp_path: Path) -> None:
    live = ("train", "--backend", "live", "--profile", str(tmp_path / "none.toml"), "--out", tmp_path / "run")
    assert run(*live) == 2
    assert not (tmp_path / "run").exists()
    (tmp_path / "run" / "view").mkdir(parents=True)
    assert run(*live) == 2
    (tmp_path / "run" / "view").mkdir(parents=True, exist_ok=True)
    (tmp_path / "run" / "view" / "mine.txt").write_text("mine")
    assert run(*live) == 2
    assert (tmp_path / "run" / "view" / "mine.txt").read_text() == "mine"


def test_without_a_terminal_the_run_prints_its_lines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("train", "--episodes", "3", "--out", tmp_path / "run", "--view") == 0

    said = capsys.readouterr()
    assert "run:        " in said.out
    assert "\x1b" not in said.out + said.err
