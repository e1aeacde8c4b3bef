"""The status of a study, from what its processes report."""

from collections.abc import Iterable

from mc_nested.studies.job import Job
from mc_nested.studies.outcome import JobOutcome
from mc_nested.workers.messages import JobEnded, JobReport


class StudyStatus:
    """Episodes, updates and recent scores of all jobs together.

    Args:
        jobs: all jobs, with the outcomes of those that were finished before.
    """

    def __init__(self, jobs: Iterable[tuple[Job, JobOutcome | None]]) -> None:
        self._jobs: dict[str, Job] = {}
        self._episodes: dict[str, int] = {}
        self._updates: dict[str, int] = {}
        self._updates_at_first: dict[str, int] = {}
        self._scores: dict[tuple[str, str], dict[int, float]] = {}
        self._ended: set[str] = set()
        self.optimum: dict[str, float] = {}
        """Each scenario's highest score, in the order of the scenarios."""
        self.groups: list[str] = []
        """Groups of which anything is known, the latest trained at the end."""
        for job, outcome in jobs:
            self._jobs[job.name] = job
            self.optimum.update({scenario.name: scenario.optimum for scenario in job.scenarios})
            if outcome:
                self._episodes[job.name] = job.episodes
                self._ended.add(job.name)
                self._take(job, [run.evaluations[-1].score for run in outcome.runs])
        self.episodes_before = self.episodes
        """Episodes that were done before the first report."""

    @property
    def total(self) -> int:
        """Episodes of the whole study."""
        return sum(job.episodes for job in self._jobs.values())

    @property
    def episodes(self) -> int:
        """Episodes that are done."""
        return sum(self._episodes.values())

    @property
    def updates(self) -> int:
        """Updates since each job's first report."""
        return sum(self._updates.values()) - sum(self._updates_at_first.values())

    def hear(self, heard: JobReport | JobEnded) -> None:
        """Record a message of a process."""
        job = self._jobs[heard.job]
        if isinstance(heard, JobEnded):
            if heard.finished:
                self._episodes[job.name] = job.episodes
                self._ended.add(job.name)
            return
        if job.name not in self._updates:
            self._updates_at_first[job.name] = heard.updates
            self.episodes_before += sum(heard.episodes)
        self._episodes[job.name] = sum(heard.episodes)
        self._updates[job.name] = heard.updates
        self._take(job, heard.scores)

    def score(self, group: str, scenario: str) -> float | None:
        """Return the mean of the last greedy scores of the runs that were evaluated."""
        scores = self._scores.get((group, scenario), {})
        return sum(scores.values()) / len(scores) if scores else None

    def ended(self, group: str) -> tuple[int, int]:
        """Return how many of a group's runs have ended, and how many there are."""
        of_group = [(name, job.groups.count(group)) for name, job in self._jobs.items()]
        return sum(runs for name, runs in of_group if name in self._ended), sum(runs for _, runs in of_group)

    def at_optimum(self, group: str) -> int:
        """Return how many of a group's runs were at their scenario's optimum in their last greedy episode."""
        return sum(
            score >= self.optimum[scenario]
            for (own, scenario), scores in self._scores.items()
            if own == group
            for score in scores.values()
        )

    def _take(self, job: Job, scores: Iterable[float | None]) -> None:
        self.groups = [group for group in self.groups if group not in job.groups] + list(dict.fromkeys(job.groups))
        for group, scenario, trial, score in zip(job.groups, job.scenarios, job.trials, scores, strict=True):
            if score is not None:
                self._scores.setdefault((group, scenario.name), {})[trial] = score
