"""A made-up benchmark: two contestants on designs of every kind, one of which fails on some."""

import numpy as np

from mc_nested.arena.design import KINDS
from mc_nested.report.benchmark_results import Benchmark, BenchmarkRow


def row(preset: str, number: int, played: int | None, trial: int = 0, blocks: int = 10) -> BenchmarkRow:
    kind = KINDS[number % 3]
    best = blocks + 10.0 if played else blocks + 7.0
    without = round(211 / (blocks + 1) + 1, 2)
    return BenchmarkRow(
        "nested", preset, f"{kind}-{number:03d}", kind, blocks, trial, blocks + 10.0, best, played, without, 1000
    )


def made_benchmark(designs: int = 12, trials: int = 2) -> Benchmark:
    random = np.random.default_rng(3)
    rows = [
        row("quick", number, int(random.integers(5, 30)), trial, 5 + number % 16)
        for number in range(designs)
        for trial in range(trials)
    ]
    rows += [
        row("sl|ow", number, None if random.random() < 0.4 else int(random.integers(60, 900)), trial, 5 + number % 16)
        for number in range(designs)
        for trial in range(trials)
    ]
    return Benchmark(
        None,
        trials,
        4,
        {"nested, quick": 100, "nested, sl|ow": 3000},
        rows,
        {"nested, quick": [1.0, 3.0], "nested, sl|ow": [20.0]},
    )
