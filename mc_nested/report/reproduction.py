"""The files of a repeated experiment: results.csv, figure5.png, figure5.svg and report.md."""

from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.claims.judge import judge
from mc_nested.report.figure5 import draw_figure5
from mc_nested.report.report_text import report_text
from mc_nested.report.results import Results, write_evaluations
from mc_nested.report.verdicts import JudgedClaim


def write_reproduction(folder: Path, results: Results, longer: Results | None = None) -> tuple[JudgedClaim, ...]:
    """Write the files, each atomically, and return what was judged; OSError if the disk refuses.

    ``longer``, the same with ten times the episodes, is judged for claim (f) and kept in results_longer.csv. All but
    report.md's lines with seconds is the same for the same results, to the byte.
    """
    claims = judge(results, longer)
    write_evaluations(folder / "results.csv", results.evaluations)
    if longer:
        write_evaluations(folder / "results_longer.csv", longer.evaluations)
    draw_figure5(folder, results)
    with atomic_write(folder / "report.md") as unfinished:
        unfinished.write_text(report_text(results, claims, longer), encoding="utf-8", newline="\n")
    return claims
