"""The files of reproduce --beyond: beyond.md, beyond.png and beyond.csv."""

from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.beyond.arms import Arms
from mc_nested.report.beyond.claims import judge_beyond
from mc_nested.report.beyond.figure import draw_beyond
from mc_nested.report.beyond.rows import write_arms
from mc_nested.report.beyond.text import beyond_text
from mc_nested.report.verdicts import JudgedClaim


def write_beyond(folder: Path, arms: Arms, trials: int, seed: int) -> tuple[JudgedClaim, ...]:
    """Write the files, each atomically, and return what was judged; OSError if the disk refuses."""
    claims = judge_beyond(arms)
    write_arms(folder / "beyond.csv", arms.values())
    draw_beyond(folder / "beyond.png", arms)
    with atomic_write(folder / "beyond.md") as unfinished:
        unfinished.write_text(beyond_text(arms, claims, trials, seed), encoding="utf-8", newline="\n")
    return claims
