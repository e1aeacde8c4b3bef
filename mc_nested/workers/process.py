"""A process of this computer that trains a study's jobs, one after the other, until it has to stop.

It talks to its parent through a pipe. The parent sends jobs; any message while a job trains, and the pipe's end, mean:
save and stop. The process sends JobReports, and one JobEnded for each job.
"""

import signal
from multiprocessing.connection import Connection
from types import FrameType

from mc_nested.workers.messages import JobReport
from mc_nested.workers.training import train_job

REPORT_EVERY_S = 0.25
"""Seconds between two reports, and between two looks whether to stop."""


def serve_jobs(pipe: Connection) -> None:
    """Receive jobs and their folders, one by one, until None or the pipe's end: the process's main function."""
    stop = _StopSignal()

    def report(now: JobReport) -> bool:
        try:
            pipe.send(now)
            return not (pipe.poll() or stop.came)
        except (EOFError, ConnectionError):
            return False

    try:
        while (task := pipe.recv()) is not None and not stop.came:
            job, folder = task
            pipe.send(train_job(job, folder, report, REPORT_EVERY_S))
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
