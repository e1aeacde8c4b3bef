"""benchmark.md: what was measured, a table over all designs, and one for each kind of designs."""

from collections.abc import Sequence
from statistics import median

from mc_nested.arena.design import CORNER, EDGE, KINDS, SCATTERED
from mc_nested.report.benchmark_measures import Measures, measures_of, trials_of
from mc_nested.report.benchmark_results import Benchmark

HEADER = (
    "agent, preset",
    "solved",
    "median",
    "interquartile mean (95 %)",
    "worst",
    "without a prior",
    "within twice that",
    "given up after",
)

WHAT_KINDS_ARE = {
    EDGE: "every block shares an edge with another, and all hang together so",
    CORNER: "they hang together by corners, too",
    SCATTERED: "they don't hang together",
}

LEGEND = """\
Figures are episodes played until the first greedy one at the optimum, greedy ones included; a trial that was never
there counts as infinite (∞). Interquartile mean: of the middle half of all trials. Its interval is a stratified
bootstrap: designs drawn again within their kind, trials within their design. Means, profile and bootstrap are rliable's
(Agarwal et al., Deep Reinforcement Learning at the Edge of the Statistical Precipice, NeurIPS 2021). Without a prior:
what a design should take if no cell were likelier than another. If n of N cells are to be built, (N + 1) / (n + 1)
episodes that test n cells each find them all, and one more builds them; the median over the designs. Within twice that:
the share of trials that took at most twice what their own design should take so. Given up after: that many training
episodes."""


def benchmark_text(benchmark: Benchmark, overall: Sequence[tuple[str, Measures]]) -> str:
    """The report as Markdown; the same rows give the same text but for the line of seconds."""
    designs = {row.design: row for row in benchmark.rows}
    origin = f"of `{benchmark.corpus}`" if benchmark.corpus else f"drawn from seed {benchmark.seed}"
    trials = f"{benchmark.trials} trials" if benchmark.trials > 1 else "One trial"
    blocks = [row.blocks for row in designs.values()]
    sizes = f"{min(blocks)} to {max(blocks)}" if min(blocks) < max(blocks) else f"{blocks[0]}"
    of_what = f"{_designs(len(designs))} of {sizes} blocks {origin}"
    parts = [
        "# Episodes to the optimum on designs that nobody tuned on",
        f"{of_what}. {trials} on each, seed {benchmark.seed}.",
        "![Share of trials solved within a number of episodes; episodes on each kind of designs](benchmark.png)",
        _table(benchmark, overall),
    ]
    for kind in KINDS:
        of_kind = [row for row in designs.values() if row.kind == kind]
        if of_kind and len(of_kind) < len(designs):
            own = [(name, measures_of(trials_of(benchmark, name, kind))) for name in benchmark.most_episodes]
            parts += [f"## {kind}: {WHAT_KINDS_ARE[kind]} ({_designs(len(of_kind))})", _table(benchmark, own)]
    seconds = [f"{name} {median(own):.1f} (at most {max(own):.1f})" for name, own in benchmark.seconds.items()]
    parts += [
        LEGEND.replace("\n", " "),
        "Updates of a trial, median: " + "; ".join(_updates(benchmark)) + ".",
        "Seconds of one core a trial, median: " + "; ".join(seconds) + ".",
    ]
    return "\n\n".join(parts) + "\n"


def _designs(number: int) -> str:
    return f"{number} designs" if number > 1 else "one design"


def _table(benchmark: Benchmark, found: Sequence[tuple[str, Measures]]) -> str:
    lines: list[Sequence[str]] = [HEADER, ["---"] * len(HEADER)]
    lines += [(name, *measures.in_words(), f"{benchmark.most_episodes[name]:,}") for name, measures in found]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def _updates(benchmark: Benchmark) -> list[str]:
    return [
        f"{name} {median(row.updates for row in benchmark.rows if row.contestant == name):,.0f}"
        for name in benchmark.most_episodes
    ]
