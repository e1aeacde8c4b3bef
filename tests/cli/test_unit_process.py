"""What one of an experiment's processes does with what comes through its pipe; here in this process."""

import signal
from collections.abc import Iterator
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread

import pytest

from mc_nested.cli.unit_process import Ended, Report, train_units
from mc_nested.learn.unit_training import OUTCOME, outcome_of
from tests.learn.experiments import DOT, one_unit

UNIT = one_unit("nested", [DOT], 2)


@pytest.fixture
def pipe() -> Iterator[tuple[Connection, Connection]]:
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    ours, theirs = Pipe()
    yield ours, theirs
    ours.close()
    theirs.close()
    for number, handler in before.items():
        signal.signal(number, handler)


def heard(pipe: Connection) -> list[Report | Ended]:
    messages = []
    while pipe.poll():
        messages.append(pipe.recv())
    return messages


def test_units_are_trained_one_after_the_other(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    said: list[Report | Ended] = []

    def parent() -> None:
        for name in ("one", "two"):
            ours.send((UNIT, tmp_path / name))
            while not said or not isinstance(said[-1], Ended):
                said.append(ours.recv())
            said.append(Report("", (), (), 0))
        ours.send(None)

    thread = Thread(target=parent)
    thread.start()
    train_units(theirs)
    thread.join()
    assert said.count(Ended(UNIT.name, finished=True)) == 2
    one, two = (outcome_of(UNIT, tmp_path / name) for name in ("one", "two"))
    assert one
    assert two
    assert one.runs == two.runs


def test_told_to_stop_it_saves_and_ends(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send((UNIT, tmp_path))
    ours.send(None)
    train_units(theirs)
    report, ended = heard(ours)
    assert isinstance(report, Report)
    assert ended == Ended(UNIT.name, finished=False)
    assert (tmp_path / "checkpoint").exists()


def test_without_its_parent_it_saves_and_ends(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send((UNIT, tmp_path))
    ours.close()
    train_units(theirs)
    assert (tmp_path / "checkpoint").exists()
    assert not (tmp_path / OUTCOME).exists()


def test_ctrl_c_is_left_to_the_parent(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send(None)
    train_units(theirs)
    signal.raise_signal(signal.SIGINT)
    assert list(tmp_path.iterdir()) == []


def test_a_checkpoint_of_something_else_is_said(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send((one_unit("nested", [DOT], 3), tmp_path))
    ours.send(None)
    train_units(theirs)
    heard(ours)
    saved = {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()}
    ours.send((UNIT, tmp_path))
    ours.send(None)
    train_units(theirs)
    (ended,) = heard(ours)
    assert isinstance(ended, Ended)
    assert "belongs to another scenario, agent or preset" in ended.failed
    assert {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()} == saved
