"""Keep track of which worker of a cluster trains which job, and which workers were lost, by its scheduler's events."""

from collections.abc import Iterable
from typing import Any


class ClusterWorkers:
    """The workers of one study.

    Args:
        workers: the addresses of those that are there at the beginning.
    """

    def __init__(self, workers: Iterable[str]) -> None:
        self._workers = set(workers)
        self._trained_by: dict[str, str] = {}
        self._lost_workers = self._lost_jobs = 0

    @property
    def count(self) -> int:
        """How many workers there are."""
        return len(self._workers)

    @property
    def trained(self) -> int:
        """How many jobs they train now."""
        return len(self._trained_by)

    def trains(self, job: str) -> bool:
        """Return whether one of them trains the job now."""
        return job in self._trained_by

    def begins(self, job: str, worker: str) -> None:
        """Note that the worker trains the job, since it has told of it."""
        self._trained_by[job] = worker

    def ends(self, job: str) -> None:
        """Note that nobody trains the job any more."""
        self._trained_by.pop(job, None)

    def note(self, said: dict[str, Any]) -> None:
        """Note an event of the scheduler's topic ``all``: a worker came, or went."""
        if said.get("action") == "add-worker":
            # A game is a worker, too. It isn't told apart here, and has no jobs to lose.
            self._workers.add(said["worker"])
        elif said.get("action") == "remove-worker":
            self._workers.discard(said["worker"])
            its_jobs = [name for name, worker in self._trained_by.items() if worker == said["worker"]]
            for name in its_jobs:
                del self._trained_by[name]
            if its_jobs or not said["expected"]:
                self._lost_workers += 1
                self._lost_jobs += len(its_jobs)

    def in_words(self, unfinished: int) -> str:
        """Say in a line how many workers there are, how many ``unfinished`` jobs train or wait, and what was lost."""
        waiting = unfinished - self.trained
        words = f"{counted(self.count, 'worker')}, {counted(self.trained, 'job')} training, {waiting} waiting"
        if self._lost_workers:
            words += f"; lost {counted(self._lost_workers, 'worker')}, {counted(self._lost_jobs, 'job')} begun again"
        return words


def counted(count: int, what: str) -> str:
    """Return ``1 worker``, ``2 workers``."""
    return f"{count:,} {what}" if count == 1 else f"{count:,} {what}s"
