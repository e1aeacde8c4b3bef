"""The files of a sensitivity run: sweep.csv, sweep.md and sweep.png."""

from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.sweep_figure import draw_sweep
from mc_nested.report.sweep_results import Sweep, write_rows
from mc_nested.report.sweep_text import sweep_text


def write_sweep(folder: Path, sweep: Sweep) -> None:
    """Write the files, each atomically, the same for the same rows; OSError if the disk refuses."""
    write_rows(folder / "sweep.csv", sweep.rows)
    draw_sweep(folder / "sweep.png", sweep)
    with atomic_write(folder / "sweep.md") as unfinished:
        unfinished.write_text(sweep_text(sweep), encoding="utf-8", newline="\n")
