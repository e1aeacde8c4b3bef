"""How a job ended that a cluster's worker trained: its files are put in its folder, or it is said what went wrong."""

from concurrent.futures import Future
from pathlib import Path

from mc_nested.errors import RunError, UserError
from mc_nested.report.tensorboard import FOLDER
from mc_nested.studies.job import Job
from mc_nested.workers.cluster.job_task import Trained
from mc_nested.workers.cluster.shipped_files import land, write_below
from mc_nested.workers.messages import JobEnded

WHY_LOST = "if nobody stopped them, it needs more memory than they have"


def landed_from(trained: Trained, folder: Path) -> JobEnded:
    """Put what a worker sent into the job's folder: how the job ended. RunError if the disk refuses."""
    try:
        if not trained.ended.failed:
            land(folder, trained.files)
            write_below(folder.parent.parent / FOLDER, trained.events)
    except OSError as error:
        raise RunError(f"{folder}: can't be written ({error}): make room") from error
    return trained.ended


def cancel(future: Future[JobEnded]) -> None:
    """Let whoever waits for it know that it was cancelled."""
    future.cancel()
    future.set_running_or_notify_cancel()


def lost(job: Job, workers: int) -> RunError:
    """Return the end of a job that was lost with each of so many workers, and is given up."""
    return RunError(f"job {job.name} was lost with each of {workers} workers: {WHY_LOST}")


def in_words(job: Job, error: Exception) -> RunError:
    """Return what went wrong with a job, as one line."""
    if isinstance(error, UserError):
        return RunError(str(error))
    return RunError(f"job {job.name} failed on a worker: {type(error).__name__}: {error}")
