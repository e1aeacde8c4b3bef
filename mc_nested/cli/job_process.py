"""A process that trains an experiment's jobs, one after the other, until it has to stop.

It talks to its parent through a pipe. The parent sends jobs; any message while a job trains, and the pipe's end, mean:
save and stop. The process sends JobReports, and one JobEnded for each job.
"""

import re
import signal
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from types import FrameType

from mc_nested.arena.cooperative.team import Team
from mc_nested.arena.cooperative.team_env import TeamEnv
from mc_nested.errors import UserError
from mc_nested.learn.cooperation.team_agent import Kind
from mc_nested.learn.cooperation.team_trainer import TeamArena, arena_of
from mc_nested.learn.experiments.job_trainers import agents_trainer, team_trainer
from mc_nested.learn.experiments.job_training import JobTraining, Training, writing
from mc_nested.learn.experiments.jobs import PLANNER, Job
from mc_nested.learn.experiments.planner_training import PlannerTraining
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.learn.trainer import Trainer
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from sim.grid import GridVectorEnv
from sim.team_grid import TeamGrid

REPORT_EVERY_S = 0.25
"""Seconds between two reports, and between two looks whether to stop."""

PATIENCE_S = 10.0
"""Seconds that a process whose parent was killed may take to save the job that another goes on with."""


@dataclass(frozen=True)
class JobReport:
    """How far a job has got: training episodes and last greedy score of each run, None before the first; updates."""

    job: str
    episodes: Sequence[int]
    scores: Sequence[float | None]
    updates: int


@dataclass(frozen=True)
class JobEnded:
    """A job is finished, or was saved unfinished because it had to stop, or ``failed`` says why it failed."""

    job: str
    finished: bool
    failed: str = ""


def train_jobs(pipe: Connection) -> None:
    """The process's main function: receives jobs and their folders, one by one, until None or the pipe's end."""
    stop = _StopSignal()
    try:
        while (task := pipe.recv()) is not None and not stop.came:
            job, folder = task
            pipe.send(_train(pipe, job, folder, stop))
    except (EOFError, ConnectionError):
        return  # the parent was killed; the job is saved


class _StopSignal:
    """Ctrl+C reaches every process of a terminal and is left to the parent; SIGTERM is meant for this process."""

    def __init__(self) -> None:
        self.came = False
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, self._take_note)

    def _take_note(self, _number: int, _frame: FrameType | None) -> None:
        self.came = True


def _train(pipe: Connection, job: Job, folder: Path, stop: _StopSignal) -> JobEnded:
    try:
        with folder_lock(folder, PATIENCE_S):
            training = _training_of(job, folder)
            _tick_until_done(pipe, training, folder, stop)
            if training.finished:
                training.finish()
            else:
                training.save()
    except UserError as error:
        return JobEnded(job.name, finished=False, failed=str(error))
    except MemoryError:
        return JobEnded(job.name, finished=False, failed="not enough memory: fewer --trials, or a smaller preset")
    return JobEnded(job.name, finished=training.finished)


def _training_of(job: Job, folder: Path) -> Training:
    if job.builders:
        return JobTraining(job, folder, team_trainer(job, _team_arenas))
    arenas = GridVectorEnv(job.scenarios)
    if job.library is None:
        return JobTraining(job, folder, agents_trainer(job, arenas))
    if job.library == PLANNER:
        return PlannerTraining(job, folder, arenas)
    from mc_nested.learn.experiments.sb3_training import Sb3Training  # only where the library is asked for

    return Sb3Training(job, folder, arenas, GridVectorEnv(job.scenarios))


def _team_arenas(team: Team, networks: Kind, runs: int) -> list[TeamArena]:
    return [arena_of(TeamEnv(TeamGrid(team), team), networks) for _ in range(runs)]


def _events(training: Training, folder: Path) -> TensorBoard | None:
    if not (isinstance(training, JobTraining) and isinstance(training.trainer, Trainer) and is_installed()):
        return None
    job = training.job
    names = (
        re.sub(r"[^\w.-]+", "-", f"{group}-{scenario.name}-{trial}")
        for group, scenario, trial in zip(job.groups, job.scenarios, job.trials, strict=True)
    )
    with writing(folder):
        return TensorBoard([folder.parent.parent / FOLDER / name for name in names], training.trainer)


def _tick_until_done(pipe: Connection, training: Training, folder: Path, stop: _StopSignal) -> None:
    report_at = time.monotonic()
    events = _events(training, folder)
    scores: list[float | None] = [None] * len(training.job.trials)
    seen = 0
    while True:
        # Reported before the first tick and after the last, too: a job may be over before a report is due.
        is_over = training.finished or stop.came
        if is_over or time.monotonic() >= report_at:
            report_at = time.monotonic() + REPORT_EVERY_S
            rows = training.evaluation_rows
            for row in rows[seen:]:
                scores[row.trial] = row.score
            seen = len(rows)
            report = JobReport(training.job.name, training.episodes_done.tolist(), tuple(scores), training.updates)
            if not _report(pipe, report) or is_over:
                return
        training.tick()
        if events:
            with writing(folder):
                events.write()


def _report(pipe: Connection, report: JobReport) -> bool:
    """Send the report; return whether to go on."""
    try:
        pipe.send(report)
        return not pipe.poll()
    except (EOFError, ConnectionError):
        return False
