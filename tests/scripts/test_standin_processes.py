"""Starting, recognising and ending processes. Real ones, since what is tested is what Linux says of them."""

import os
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from scripts.standin_processes import (
    Running,
    StandinError,
    State,
    clean_up,
    last_line,
    load_state,
    remove_socket,
    start,
    start_time,
    stop,
    wait_until,
)

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the stand-in is for Linux")

SLEEP = "import time; time.sleep(60)"
STUBBORN = (
    "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('deaf', flush=True); time.sleep(60)"
)
PARENT = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {SLEEP!r}])"


@pytest.fixture
def state(tmp_path: Path) -> Iterator[State]:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    state = State(tmp_path / "state.json", scratch=str(scratch))
    yield state
    for process in state.processes:
        stop(process, 0)


def launch(state: State, code: str, name: str = "one") -> Running:
    folder = state.path.parent
    process = start(name, [sys.executable, "-c", code], folder / f"{name}.log", folder, os.environ)
    state.processes.append(process)
    return process


def test_a_started_process_is_alive_until_it_is_stopped(state: State) -> None:
    process = launch(state, SLEEP)
    assert process.is_alive
    assert process.pids() == [process.pid]
    assert stop(process)
    assert not process.is_alive


def test_a_process_takes_its_children_with_it(state: State) -> None:
    process = launch(state, PARENT)
    assert wait_until(lambda: len(process.pids()) == 2, 10)
    assert stop(process, 0.5)
    assert process.pids() == []


def test_one_that_does_not_listen_is_killed(state: State) -> None:
    process = launch(state, STUBBORN)
    log = state.path.parent / "one.log"
    assert wait_until(lambda: "deaf" in log.read_text(), 10)
    assert stop(process, 0.2)
    assert not process.is_alive


def test_another_process_with_the_same_pid_is_left_alone(state: State) -> None:
    process = launch(state, SLEEP)
    earlier = Running("earlier", process.pid, process.started - 1)
    assert not earlier.is_alive
    assert stop(earlier)
    assert process.is_alive


def test_a_free_pid_is_no_process() -> None:
    child = subprocess.Popen([sys.executable, "-c", ""])
    child.wait(30)
    assert start_time(child.pid) is None


def test_the_state_comes_back_as_it_was_saved(state: State) -> None:
    state.ready, state.display, state.facts = True, ":7", {"oracle": "http://127.0.0.1:1"}
    launch(state, SLEEP)
    state.save()
    loaded = load_state(state.path)
    assert loaded == state
    assert loaded is not None
    assert loaded.is_up


def test_a_state_whose_process_has_ended_is_not_up(state: State) -> None:
    state.ready = True
    stop(launch(state, SLEEP))
    assert not state.is_up


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"processes": [{"name": "x", "pid": "y", "started": 1}]}'])
def test_a_damaged_state_is_an_error(text: str, tmp_path: Path) -> None:
    path = tmp_path / "state.json"
    path.write_text(text)
    with pytest.raises(StandinError, match="damaged"):
        load_state(path)


def test_cleaning_up_leaves_nothing(state: State) -> None:
    processes = [launch(state, SLEEP, "one"), launch(state, SLEEP, "two")]
    state.save()
    clean_up(state)
    assert not any(process.is_alive for process in processes)
    assert not state.path.exists()
    assert not Path(state.scratch).exists()


def test_a_display_that_another_server_has_by_now_keeps_its_socket(tmp_path: Path) -> None:
    path = tmp_path / "X5"
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(path))
        server.listen()
        remove_socket(":5", tmp_path)
        assert path.exists()
    remove_socket(":5", tmp_path)
    assert not path.exists()
    remove_socket(":5", tmp_path)


def test_the_last_line_of_a_log_is_the_last_that_says_something(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.write_bytes(b"first\nlast \xff\n \n\n")
    assert last_line(log) == "last \N{REPLACEMENT CHARACTER}"
    log.write_bytes(b"")
    assert "is empty" in last_line(log)
