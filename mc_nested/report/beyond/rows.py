"""beyond.csv: every greedy evaluation of every arm."""

import csv
from collections.abc import Iterable
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.beyond.arms import ArmResults

HEADER = (
    "topic",
    "scenario",
    "agent",
    "trial",
    "episode",
    "score",
    "material",
    "steps",
    "trained_steps",
    "updates",
)


def write_arms(path: Path, arms: Iterable[ArmResults]) -> None:
    """Write them as CSV, atomically; OSError if the disk refuses.

    ``steps`` are the greedy episode's; ``trained_steps`` and ``updates`` what the trial had spent before it.
    """
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for arm in arms:
            for number, trial in enumerate(arm.trials):
                for row in trial:
                    reached = row.episode, row.score, row.material, row.steps, row.trained_steps, row.updates
                    writer.writerow((arm.topic, arm.scenario, arm.name, number, *reached))
