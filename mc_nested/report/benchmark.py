"""The files of a benchmark: benchmark.csv, benchmark.md and benchmark.png."""

from collections.abc import Sequence
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.benchmark_figure import draw_benchmark
from mc_nested.report.benchmark_measures import Measures, measures_of, trials_of
from mc_nested.report.benchmark_results import Benchmark, write_rows
from mc_nested.report.benchmark_text import benchmark_text


def write_benchmark(folder: Path, benchmark: Benchmark) -> Sequence[tuple[str, Measures]]:
    """Write the files, each atomically, and return each contestant's figures; OSError if the disk refuses.

    The same rows give the same bytes, except for the report's line of seconds.
    """
    overall = [(name, measures_of(trials_of(benchmark, name))) for name in benchmark.most_episodes]
    write_rows(folder / "benchmark.csv", benchmark.rows)
    draw_benchmark(folder / "benchmark.png", benchmark)
    with atomic_write(folder / "benchmark.md") as unfinished:
        unfinished.write_text(benchmark_text(benchmark, overall), encoding="utf-8", newline="\n")
    return overall
