"""The files of a run that are written whole: a text, and a table of rows."""

import csv
from collections.abc import Sequence
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow


def write_text(path: Path, text: str) -> None:
    """Replace the file by that text; OSError if the disk refuses, the old one is whole then."""
    with atomic_write(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8")


def write_table(path: Path, header: Sequence[str], rows: Sequence[EpisodeRow | EvaluationRow]) -> None:
    """Replace the file by a CSV of those rows; OSError if the disk refuses, the old one is whole then."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
