"""A job on a cluster's worker: sent there with its files, trained in a folder of its own, and its files brought back.

It runs in a thread of a Dask worker. Only jobs that begin are unpickled: after the versions were compared. They decide
what a training computes: a worker needs the same as the machine that sends it jobs.
"""

import hashlib
import importlib.metadata
import os
import pickle
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from functools import cache
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.compiled import ROOT
from mc_nested.errors import ClusterError, RunError, UserError
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.report.tensorboard import FOLDER
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME
from mc_nested.workers.executor import JobEnded, JobReport, train_job
from mc_nested.workers.processes import ONE_THREAD_EACH

if TYPE_CHECKING:
    from distributed import Worker

PACKAGES = ("mc_nested", "sim")
"""Whose files a job's results depend on."""

LIBRARIES = ("numpy", "numba", "llvmlite", "torch", "distributed")
"""Whose versions they depend on, or the messages between the machines."""

BESIDE_ANOTHER = ("gymnasium",)
"""What an agent of another library also depends on."""

MISSING = "missing"

Versions = Mapping[str, str]


@cache
def own_versions(library: str | None = None) -> Versions:
    """Return this machine's versions, by name: this project's with a hash of its files, and any build's libraries'.

    With those that decide what an agent of another library learns, if one is named.
    """
    own = f"{importlib.metadata.version('mc-nested')} ({_hash_of_files(ROOT)})"
    others = (library, *BESIDE_ANOTHER) if library else ()
    return {"mc-nested": own, **{name: _version_of(name) for name in (*LIBRARIES, *others)}}


def differences(wanted: Versions, own: Versions) -> str:
    """Return what differs, in words; empty if nothing does."""
    differing = [name for name in wanted if wanted[name] != own.get(name)]
    return ", ".join(f"{name} {own.get(name, MISSING)} instead of {wanted[name]}" for name in differing)


def _version_of(library: str) -> str:
    try:
        return importlib.metadata.version(library).partition("+")[0]
    except importlib.metadata.PackageNotFoundError:
        return MISSING


def _hash_of_files(root: Path) -> str:
    """Return a short hash of all that is computed with.

    A file's line ends, which differ between systems, don't count.
    """
    digest = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode())
            digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest()[:8]


Files = Mapping[str, bytes]
"""Contents by path, relative to a folder, with slashes."""

CHECKPOINT = "checkpoint"


def files_below(folder: Path) -> Files:
    """Return the folder's files; none where there is no such folder."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != LOCK)
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def write_below(folder: Path, files: Files) -> None:
    """Write the files into the folder; OSError if the disk refuses."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(path) as unfinished:
            unfinished.write_bytes(content)


def land(folder: Path, files: Files) -> None:
    """Put what came back of a job into its folder, in place of the checkpoint there; OSError if the disk refuses.

    Whenever the process is killed, the folder holds the old checkpoint, the new one or the outcome, each whole, or
    nothing, so that the job begins anew.
    """
    current, new, old = folder / CHECKPOINT, folder / f"{CHECKPOINT}.new", folder / f"{CHECKPOINT}.old"
    for leftover in (new, old):
        shutil.rmtree(leftover, ignore_errors=True)
    inside = f"{CHECKPOINT}/"
    saved = {name.removeprefix(inside): each for name, each in files.items() if name.startswith(inside)}
    write_below(new, saved)
    write_below(folder, {name: each for name, each in files.items() if name == OUTCOME})
    if current.exists():
        current.rename(old)
    if saved:
        new.rename(current)
    shutil.rmtree(old, ignore_errors=True)


REPORT_EVERY_S = 1.0
"""Seconds between two reports, which all go through one scheduler, and between two looks whether to stop."""

JOBS = "jobs"
"""The folder's name above a job's, as in a study's folder: what a job writes beside it lands there, too."""

GAME = "game"
"""The resource of workers that are games: jobs leave them alone."""

ELSEWHERE_S = 0.5
"""Seconds until a job that was given to a game is given to another worker."""

_one_at_a_time = Lock()
"""A worker may have several threads; random numbers of stable-baselines3 are a whole process's."""

_AT_WORK = ("running", "paused", "closing_gracefully")
"""What a worker's status is as long as its scheduler can be reached; ``paused`` is for too little memory."""

_stopped: set[str] = set()
"""The topics of studies that were stopped, in this worker's process."""


class Trained(NamedTuple):
    """How a job ended, its folder's files, and the events for TensorBoard."""

    ended: JobEnded
    files: Files
    events: Files


def packed(job: Job, folder: Path) -> bytes:
    """Return the job and the files of its folder, for ``train_on_worker``."""
    return pickle.dumps((job, files_below(folder)))


def train_on_worker(versions: Versions, library: str | None, package: bytes, topic: str) -> Trained:
    """Train a packed job until it is finished, or saved because its study was stopped or its task cancelled.

    ``library`` is whose agent it is: its version has to be the same, too.

    ClusterError if this worker's versions aren't those.
    """
    from distributed import Reschedule, get_worker

    worker: Worker = get_worker()
    if GAME in worker.state.total_resources:
        time.sleep(ELSEWHERE_S)  # nobody else may be there for a while
        raise Reschedule
    if differing := differences(versions, own_versions(library)):
        message = f"the worker at {worker.address} has {differing}: install the same on both"
        print(f"mc-nested: a job was refused: {message}", file=sys.stderr, flush=True)
        raise ClusterError(message)
    job, files = pickle.loads(package)  # noqa: S301 - from the client, which the scheduler has let in
    is_wanted = wanted_here(worker)

    def report(now: JobReport) -> bool:
        plain = {**vars(now), "episodes": list(now.episodes), "scores": list(now.scores), "worker": worker.address}
        worker.log_event(topic, plain)
        return topic not in _stopped and is_wanted()

    with _one_at_a_time, tempfile.TemporaryDirectory(prefix="mc-nested-", dir=worker.local_directory) as root:
        os.environ.update(ONE_THREAD_EACH)  # as the processes of this computer do: another number might round otherwise
        if torch := sys.modules.get("torch"):  # it has read the environment already
            torch.set_num_threads(1)
        folder = Path(root) / JOBS / job.name
        write_below(folder, files)
        ended = train_job(job, folder, report, REPORT_EVERY_S)
        return Trained(ended, files_below(folder), files_below(Path(root) / FOLDER))


def stop_training(topic: str) -> None:
    """Let this worker save the jobs of that study, now and later."""
    _stopped.add(topic)


def wanted_here(worker: "Worker") -> Callable[[], bool]:
    """Return what tells whether this thread's task is still wanted: neither cancelled, nor its scheduler lost."""
    key = worker.get_current_task()

    def is_wanted() -> bool:
        task: Any = worker.state.tasks.get(key)
        return task is not None and task.state != "cancelled" and worker.status.name in _AT_WORK

    return is_wanted


def landed_from(trained: Trained, folder: Path) -> JobEnded:
    """Put what a worker sent into the job's folder: how the job ended. RunError if the disk refuses."""
    with refused_as(RunError, folder, "make room"):
        if not trained.ended.failed:
            land(folder, trained.files)
            write_below(folder.parent.parent / FOLDER, trained.events)
    return trained.ended


def cancel(future: Future[JobEnded]) -> None:
    """Let whoever waits for it know that it was cancelled."""
    future.cancel()
    future.set_running_or_notify_cancel()


def in_words(job: Job, error: Exception) -> RunError:
    """Return what went wrong with a job, as one line."""
    if isinstance(error, UserError):
        return RunError(str(error))
    return RunError(f"job {job.name} failed on a worker: {type(error).__name__}: {error}")
