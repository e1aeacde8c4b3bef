"""Train one job in its folder, tick by tick, until it is finished or nobody wants it to go on."""

import re
import time
from collections.abc import Callable
from pathlib import Path

from mc_nested.atomic_file import refused_as
from mc_nested.errors import RunError, UserError
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from mc_nested.studies.job import Job
from mc_nested.studies.job_training import JobTraining, agents_trainer, team_of_job
from mc_nested.studies.sb3 import Sb3Training
from mc_nested.workers.executor import JobEnded, JobReport
from sim.grid import GridVectorEnv
from sim.team_grid import team_arenas

PATIENCE_S = 10.0
"""Seconds that a process whose parent was killed may take to save the job that another goes on with."""

TrainedJob = JobTraining | Sb3Training
"""A job that is trained in its folder, by whatever algorithm."""

Report = Callable[[JobReport], bool]
"""Is told how far a job has got; returns whether the job shall go on."""


def train_job(job: Job, folder: Path, report: Report, report_every_s: float) -> JobEnded:
    """Train the job from where its folder has it, until it is finished, or saved because ``report`` returned False.

    It is reported at its beginning, at its end, and every ``report_every_s`` seconds. What a user can mend, a full disk
    or too little memory, is said in what is returned.
    """
    try:
        with folder_lock(folder, PATIENCE_S):
            training = _training_of(job, folder)
            _tick_until_done(training, folder, report, report_every_s)
            if training.finished:
                training.finish()
            else:
                training.save()
    except UserError as error:
        return JobEnded(job.name, finished=False, failed=str(error))
    except MemoryError:
        return JobEnded(job.name, finished=False, failed="not enough memory: fewer --trials, or a smaller preset")
    return JobEnded(job.name, finished=training.finished)


def _training_of(job: Job, folder: Path) -> TrainedJob:
    if team := team_of_job(job):
        return JobTraining(job, folder, agents_trainer(job, team_arenas(team, len(job.trials))))
    arenas = GridVectorEnv(job.scenarios)
    if job.arm.library is None:
        return JobTraining(job, folder, agents_trainer(job, arenas))
    return Sb3Training(job, folder, arenas, GridVectorEnv(job.scenarios))


def _events(training: TrainedJob, folder: Path) -> TensorBoard | None:
    if not (isinstance(training, JobTraining) and is_installed()):
        return None
    job = training.job
    names = (re.sub(r"[^\w.-]+", "-", f"{run.arm.name}-{run.scenario.name}-{run.trial}") for run in job.runs)
    with refused_as(RunError, folder, "make room"):
        return TensorBoard([folder.parent.parent / FOLDER / name for name in names], training.trainer)


def _tick_until_done(training: TrainedJob, folder: Path, report: Report, report_every_s: float) -> None:
    report_at = time.monotonic()
    events = _events(training, folder)
    scores: list[float | None] = [None] * len(training.job.trials)
    seen = 0
    while True:
        # Reported before the first tick and after the last, too: a job may be over before a report is due.
        if training.finished or time.monotonic() >= report_at:
            report_at = time.monotonic() + report_every_s
            rows = training.evaluation_rows
            for row in rows[seen:]:
                scores[row.trial] = row.score
            seen = len(rows)
            now = JobReport(training.job.name, training.episodes_done.tolist(), tuple(scores), training.updates)
            if not report(now) or training.finished:
                return
        training.tick()
        if events:
            with refused_as(RunError, folder, "make room"):
                events.write()
