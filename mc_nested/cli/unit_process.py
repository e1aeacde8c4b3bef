"""One of the processes that an experiment's units are shared out to: it takes one after the other until told to stop.

A process of its own sees nothing but a pipe. Into it the parent puts units; anything that comes while a unit trains,
and the pipe's end, mean: save and stop. Out of it come Reports, and one Ended for each unit.
"""

import re
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from types import FrameType

from mc_nested.errors import UserError
from mc_nested.learn.unit_training import UnitTraining
from mc_nested.learn.units import Unit
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from sim.grid import GridVectorEnv

REPORT_EVERY_S = 0.25
"""How often the parent hears of a unit, and the unit of the parent."""


@dataclass(frozen=True)
class Report:
    """How far a unit has got: training episodes and last greedy score of each run, None before the first; updates."""

    unit: str
    episodes: Sequence[int]
    scores: Sequence[float | None]
    updates: int


@dataclass(frozen=True)
class Ended:
    """A unit has come to its end, or was saved where it stood because it had to stop, or ``failed`` says why."""

    unit: str
    finished: bool
    failed: str = ""


def train_units(pipe: Connection) -> None:
    """What the process runs: units and their folders come in, one by one; None or the pipe's end is the end."""
    stop = _StopSignal()
    try:
        while (task := pipe.recv()) is not None and not stop.came:
            unit, folder = task
            pipe.send(_train(pipe, unit, folder, stop))
    except (EOFError, ConnectionError):
        return  # the parent was killed; what trained is saved


class _StopSignal:
    """Ctrl+C reaches every process of a terminal, but the parent decides; a termination is meant for this process."""

    def __init__(self) -> None:
        self.came = False
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, self._take_note)

    def _take_note(self, _number: int, _frame: FrameType | None) -> None:
        self.came = True


def _train(pipe: Connection, unit: Unit, folder: Path, stop: _StopSignal) -> Ended:
    try:
        training = UnitTraining(unit, folder, GridVectorEnv(unit.scenarios))
        _tick_until_done(pipe, training, folder, stop)
        if training.trainer.finished:
            training.finish()
        else:
            training.save()
    except UserError as error:
        return Ended(unit.name, finished=False, failed=str(error))
    except MemoryError:
        return Ended(unit.name, finished=False, failed="not enough memory: fewer --trials, or a smaller preset")
    return Ended(unit.name, finished=training.trainer.finished)


def _events(training: UnitTraining, folder: Path) -> TensorBoard | None:
    if not is_installed():
        return None
    unit = training.unit
    names = (
        re.sub(r"[^\w.-]+", "-", f"{group}-{scenario.name}-{trial}")
        for group, scenario, trial in zip(unit.groups, unit.scenarios, unit.trials, strict=True)
    )
    with training.writing():
        return TensorBoard([folder.parent.parent / FOLDER / name for name in names], training.trainer)


def _tick_until_done(pipe: Connection, training: UnitTraining, folder: Path, stop: _StopSignal) -> None:
    report_at = time.monotonic()
    events = _events(training, folder)
    scores: list[float | None] = [None] * len(training.unit.trials)
    seen = 0
    while not (training.trainer.finished or stop.came):
        training.tick()
        if events:
            with training.writing():
                events.write()
        if time.monotonic() < report_at:
            continue
        report_at = time.monotonic() + REPORT_EVERY_S
        rows = training.trainer.evaluation_rows
        for row in rows[seen:]:
            scores[row.trial] = row.score
        seen = len(rows)
        episodes = training.trainer.episodes_done.tolist()
        if not _tell(pipe, Report(training.unit.name, episodes, tuple(scores), training.trainer.agent.updates)):
            return


def _tell(pipe: Connection, report: Report) -> bool:
    """Send it; whether to go on."""
    try:
        pipe.send(report)
        return not pipe.poll()
    except (EOFError, ConnectionError):
        return False
