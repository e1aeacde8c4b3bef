"""The files of an ablation: ablation.csv, ablation.md and ablation.png."""

from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.ablation_figure import draw_ablation
from mc_nested.report.ablation_results import Ablation, write_rows
from mc_nested.report.ablation_text import ablation_text


def write_ablation(folder: Path, ablation: Ablation) -> None:
    """Write the files, each atomically, the same for the same rows; OSError if the disk refuses."""
    write_rows(folder / "ablation.csv", ablation.rows)
    draw_ablation(folder / "ablation.png", ablation)
    with atomic_write(folder / "ablation.md") as unfinished:
        unfinished.write_text(ablation_text(ablation), encoding="utf-8", newline="\n")
