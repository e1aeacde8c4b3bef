"""What a job's trainer says of it, from wherever it runs."""

from collections.abc import Sequence
from dataclasses import dataclass


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
