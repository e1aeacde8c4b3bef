"""The files of the claims under each choice: robustness.csv, robustness.md and robustness.png."""

from collections.abc import Sequence
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.robustness_figure import draw_robustness
from mc_nested.report.robustness_results import JudgedChoice, write_findings
from mc_nested.report.robustness_text import robustness_text


def write_robustness(folder: Path, choices: Sequence[JudgedChoice]) -> None:
    """Write the files, each atomically, the same for the same results; OSError if the disk refuses."""
    write_findings(folder / "robustness.csv", choices)
    draw_robustness(folder / "robustness.png", choices)
    with atomic_write(folder / "robustness.md") as unfinished:
        unfinished.write_text(robustness_text(choices), encoding="utf-8", newline="\n")
