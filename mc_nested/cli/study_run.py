"""Train all jobs of a study that aren't finished, in processes here or on a cluster, and show how far they are.

The view has a bar, and each group's greedy scores.
"""

import os
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager

from rich.console import Console, Group
from rich.live import Live
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Column, Table
from rich.text import Text

from mc_nested.cli.cluster_options import workers_of
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.output import Output, print_line
from mc_nested.cli.progress import LINE_EVERY_S
from mc_nested.errors import RunError
from mc_nested.studies.arm import Run
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import JobOutcome
from mc_nested.studies.trial import Outcomes
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.executor import JobEnded, JobExecutor, JobReport, train_jobs
from mc_nested.workers.processes import JobProcesses

REFRESH_S = 0.25
"""No more often than an eye can follow."""

MOST_ROWS = 10
"""Groups shown at once."""

MOST_COLUMNS = 8
"""Scenarios shown side by side; of more, only how many runs have ended, and at the optimum."""


class StudyStatus:
    """Episodes, updates and recent scores of all jobs together.

    Args:
        jobs: all jobs, with the outcomes of those that were finished before.
    """

    def __init__(self, jobs: Iterable[tuple[Job, JobOutcome | None]]) -> None:
        self._jobs: dict[str, Job] = {}
        self._ended: set[str] = set()
        self._first: dict[str, JobReport] = {}
        self._last: dict[str, JobReport] = {}
        """What each job has reported, the latest at the end."""
        self.optimum: dict[str, float] = {}
        """Each scenario's highest score, in the order of the scenarios."""
        for job, outcome in jobs:
            self._jobs[job.name] = job
            self.optimum.update({scenario.name: scenario.optimum for scenario in job.scenarios})
            if outcome:
                scores = tuple(run.evaluations[-1].score for run in outcome.runs)
                self.hear(JobReport(job.name, [job.preset.episodes] * len(job.runs), scores, updates=0))
                self._ended.add(job.name)

    @property
    def total(self) -> int:
        """Episodes of the whole study."""
        return sum(job.episodes for job in self._jobs.values())

    @property
    def episodes(self) -> int:
        """Episodes that are done; a job that has ended needs no more."""
        ended = sum(self._jobs[name].episodes for name in self._ended)
        return ended + sum(sum(last.episodes) for name, last in self._last.items() if name not in self._ended)

    @property
    def episodes_before(self) -> int:
        """Episodes that were done before each job's first report."""
        return sum(sum(first.episodes) for first in self._first.values())

    @property
    def updates(self) -> int:
        """Updates since each job's first report."""
        return sum(last.updates - self._first[name].updates for name, last in self._last.items())

    @property
    def groups(self) -> list[str]:
        """Groups of which anything is known, the latest trained at the end."""
        latest_first = (group for name in reversed(self._last) for group in reversed(self._jobs[name].groups))
        return list(dict.fromkeys(latest_first))[::-1]

    def hear(self, heard: JobReport | JobEnded) -> None:
        """Record a message of a process."""
        if isinstance(heard, JobReport):
            self._first.setdefault(heard.job, heard)
            self._last.pop(heard.job, None)
            self._last[heard.job] = heard
        elif heard.finished:
            self._ended.add(heard.job)

    def score(self, group: str, scenario: str) -> float | None:
        """Return the mean of the last greedy scores of the runs that were evaluated."""
        scores = [score for run, score in self._evaluated(group) if run.scenario.name == scenario]
        return sum(scores) / len(scores) if scores else None

    def ended(self, group: str) -> tuple[int, int]:
        """Return how many of a group's runs have ended, and how many there are."""
        of_group = [name in self._ended for name, job in self._jobs.items() for own in job.groups if own == group]
        return sum(of_group), len(of_group)

    def at_optimum(self, group: str) -> int:
        """Return how many of a group's runs were at their scenario's optimum in their last greedy episode."""
        return sum(score >= run.scenario.optimum for run, score in self._evaluated(group))

    def _evaluated(self, group: str) -> list[tuple[Run, float]]:
        """Return the group's runs that were evaluated, each with its last greedy score."""
        pairs = (zip(self._jobs[name].runs, last.scores, strict=True) for name, last in self._last.items())
        return [(run, score) for own in pairs for run, score in own if run.arm.name == group and score is not None]


class StudyProgress:
    """Shows a status on standard error.

    Args:
        what: what is being done, in one word.
        status: what is shown.
        console: where to show it; standard error unless given.
        workers: says how many train, and what was lost; empty where there is nothing to say.
    """

    def __init__(
        self,
        what: str,
        status: StudyStatus,
        console: Console | None = None,
        workers: Callable[[], str] = str,
    ) -> None:
        self._what = what
        self._status = status
        self._workers = workers
        self._console = console or Console(stderr=True)
        self._bar = Progress(
            TextColumn(what),
            BarColumn(bar_width=None),
            TextColumn("{task.percentage:3.0f} %"),
            TextColumn("{task.fields[figures]}"),
            TimeRemainingColumn(table_column=Column(no_wrap=True)),
            console=self._console,
            expand=True,
        )
        self._task = self._bar.add_task(what, total=status.total, completed=status.episodes, figures="")
        self._live = Live(console=self._console, auto_refresh=False, transient=True)
        self._began = time.monotonic()
        self._next = self._began

    def __enter__(self) -> "StudyProgress":
        if self._console.is_terminal:
            self._live.start()
        else:
            self._next += LINE_EVERY_S
        return self

    def __exit__(self, *_: object) -> None:
        if self._console.is_terminal:
            self._live.stop()

    def watch(self, heard: JobReport | JobEnded | None) -> None:
        """Record a message of a process, and refresh the view if it is time."""
        if heard is not None:
            self._status.hear(heard)
        now = time.monotonic()
        if now < self._next:
            return
        if self._console.is_terminal:
            self._next = now + REFRESH_S
            self._bar.update(self._task, completed=self._status.episodes, figures=self._rate())
            said = self._workers()
            view = Group(self._bar, Text(said), self._table()) if said else Group(self._bar, self._table())
            self._live.update(view, refresh=True)
        else:
            self._next = now + LINE_EVERY_S
            print_line(self._console, self._line(now))

    def _rate(self) -> str:
        return f"{self._status.updates / max(time.monotonic() - self._began, 1e-9):,.0f} updates/s"

    def _line(self, now: float) -> str:
        status = self._status
        done = status.episodes - status.episodes_before
        left = f"{(now - self._began) / done * (status.total - status.episodes) / 60:.1f} min left" if done else ""
        share = 100 * status.episodes / status.total
        parts = (f"{share:.0f} % of {status.total:,} episodes", self._rate(), left, self._workers())
        return f"{self._what}: " + "  ".join(part for part in parts if part)

    def _table(self) -> Table:
        status = self._status
        if len(status.optimum) > MOST_COLUMNS:
            return self._counts()
        heads = [Text(f"{name} of {optimum:g}") for name, optimum in status.optimum.items()]
        table = Table("recent score", *(Column(head, justify="right") for head in heads), box=None, padding=(0, 2))
        for group in status.groups[-MOST_ROWS:]:
            scores = [status.score(group, scenario) for scenario in status.optimum]
            table.add_row(Text(group), *("" if score is None else f"{score:.1f}" for score in scores))
        return table

    def _counts(self) -> Table:
        status = self._status
        heads = (Column(head, justify="right") for head in ("ended", "at the optimum"))
        table = Table("trials", *heads, box=None, padding=(0, 2))
        for group in status.groups[-MOST_ROWS:]:
            ended, runs = status.ended(group)
            table.add_row(Text(group), f"{ended} of {runs}", str(status.at_optimum(group)))
        return table


MOST_JOBS = 256
"""More would only run out of memory."""


def cores() -> int:
    """Count the cores that this process may use."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(usable, MOST_JOBS)


def jobs_at_once(cluster: SchedulerAddress | None, output: Output) -> int:
    """Return into how many jobs the work is cut, about, unless asked for: as many as train at a time."""
    return min(workers_of(cluster, output), MOST_JOBS) if cluster else cores()


def train_all(folder: StudyFolder, output: Output, cluster: SchedulerAddress | None) -> Outcomes:
    """Train all jobs that aren't finished, here or on a cluster; return the outcomes of all.

    Raise Stopped if somebody asked to stop, or RunError if a job failed. All jobs are saved then, and the message says
    how to resume.
    """
    before = folder.outcomes()
    missing = [(job, folder.folder_of(job)) for job, outcome in before if outcome is None]
    with catch_interrupts() as interrupt, ExitStack() as stack:
        executor = stack.enter_context(_executor(cluster, min(folder.config.jobs, len(missing)))) if missing else None
        folder.begin()
        output.note(f"folder: {folder.path}")
        if executor:
            status = StudyStatus(before)
            view = StudyProgress(folder.config.study, status, output.progress, executor.in_words)
            progress = stack.enter_context(view)
            try:
                train_jobs(executor, missing, lambda: interrupt.requested, progress.watch)
            except RunError as error:
                raise RunError(f"{error}; {folder.resume_command} goes on from what was saved") from error
        if interrupt.requested:
            raise Stopped(f"stopped and saved: go on with {folder.resume_command}")
    return [(job, outcome) for job, outcome in folder.outcomes() if outcome]


@contextmanager
def _executor(cluster: SchedulerAddress | None, processes: int) -> Iterator[JobExecutor]:
    if cluster is None:
        with JobProcesses(processes) as here:
            yield here
        return
    # Imported here: it is Dask's, which only a cluster needs.
    from mc_nested.workers.cluster.dask_jobs import DaskJobs

    with connected(cluster) as client:
        yield DaskJobs(client)
