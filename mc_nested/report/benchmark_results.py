"""The results of a benchmark: a row for each trial of each contestant on each design, as benchmark.csv."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from mc_nested.atomic_file import atomic_write


class BenchmarkRow(NamedTuple):
    """One trial; scores are r_M of greedy episodes.

    ``played_to_optimum`` counts every episode played until the first greedy one at the optimum, that one and the other
    greedy ones included; None: never. ``without_a_prior`` is how many it should take if no cell were likelier than
    another (benchmark.py: episodes_without_a_prior).
    """

    agent: str
    preset: str
    design: str
    kind: str
    blocks: int
    trial: int
    optimum: float
    best_score: float
    played_to_optimum: int | None
    without_a_prior: float
    updates: int

    @property
    def contestant(self) -> str:
        """Agent and preset."""
        return f"{self.agent}, {self.preset}"


@dataclass(frozen=True)
class Benchmark:
    """A benchmark: its rows, and what is needed to read them.

    Args:
        corpus: the file that the designs came from; None if they were drawn from the seed.
        trials: of each contestant on each design.
        seed: of all.
        most_episodes: training episodes after which a trial is given up, of each contestant, in their order.
        rows: of all trials, contestant by contestant, design by design.
        seconds: of computing, one figure for each of a contestant's trials.
    """

    corpus: str | None
    trials: int
    seed: int
    most_episodes: Mapping[str, int]
    rows: Sequence[BenchmarkRow]
    seconds: Mapping[str, Sequence[float]]


def played_to_optimum(evaluations: Sequence[tuple[int, float]], optimum: float) -> int | None:
    """Episodes played until the first greedy one at the optimum, that one included; None if there is none.

    ``evaluations`` are (training episodes before it, score) of every greedy episode, in their order.
    """
    for greedy, (trained, score) in enumerate(evaluations, start=1):
        if score >= optimum:
            return trained + greedy
    return None


def write_rows(path: Path, rows: Sequence[BenchmarkRow]) -> None:
    """Write them as CSV, atomically; OSError if the disk refuses."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(BenchmarkRow._fields)
        writer.writerows(rows)
