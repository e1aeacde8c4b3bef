"""sweep.md: a table for each scenario with the effect of each variant."""

from collections.abc import Sequence
from statistics import median

from mc_nested.report.inference import Interval
from mc_nested.report.sweep_results import Effect, Sweep, SweepRow, effects_on

HEADER = (
    "agent",
    "choice",
    "value",
    "final score",
    "against the base",
    "95 % interval",
    "mean over the training",
    "against the base",
    "95 % interval",
    "best",
    "at the optimum",
    "episodes to it",
)

LEGEND = """\
Final: the greedy score of the policy that a run keeps. Mean over the training: over all of a run's greedy evaluations,
so it is high where learning is early and steady. Both are means over the trials. Intervals are Welch's t of
the difference from the same agent's base, and none is corrected for being one of many: of {many} intervals some
{false:.0f} leave out 0 by chance alone. Best: the highest greedy score of any trial. At the
optimum: trials that ever reached it. Episodes to it: the median over those."""


def sweep_text(sweep: Sweep) -> str:
    """The table as Markdown; the same rows give the same text."""
    effects = {scenario: effects_on(sweep, scenario) for scenario in sweep.optimum}
    many = 2 * sum(effect.final_interval is not None for own in effects.values() for effect in own)
    trials = f"{sweep.trials} trials" if sweep.trials > 1 else "one trial"
    what = f"One choice at a time changed from the preset `{sweep.preset}`, seed {sweep.seed}"
    parts = [
        "# What each choice does",
        f"{what}: {trials} of {sweep.episodes:,} episodes for each variant and scenario.",
        "![Differences from the base, a panel for each scenario](sweep.png)",
        *(f"## {scenario}, optimum {sweep.optimum[scenario]:g}\n\n{_table(own)}" for scenario, own in effects.items()),
        LEGEND.format(many=many, false=0.05 * many).replace("\n", " "),
    ]
    return "\n\n".join(parts) + "\n"


def _table(effects: Sequence[Effect]) -> str:
    lines = [HEADER, ["---"] * len(HEADER), *(_line(effect) for effect in effects)]
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)


def _line(effect: Effect) -> Sequence[str]:
    is_base = not effect.choice
    return (
        effect.agent,
        "**base**" if is_base else effect.choice,
        effect.value,
        f"{effect.final:.2f}",
        "" if is_base else f"{_signed(effect.final_difference)}",
        _interval(effect.final_interval),
        f"{effect.mean:.2f}",
        "" if is_base else f"{_signed(effect.mean_difference)}",
        _interval(effect.mean_interval),
        f"{max(row.best_score for row in effect.rows):g}",
        *_reached(effect.rows),
    )


def _reached(rows: Sequence[SweepRow]) -> tuple[str, str]:
    episodes = [row.episodes_to_optimum for row in rows if row.episodes_to_optimum is not None]
    return f"{len(episodes)} of {len(rows)}", f"{median(episodes):,.0f}" if episodes else ""


def _interval(interval: Interval | None) -> str:
    return f"{_signed(interval.low)} to {_signed(interval.high)}" if interval else ""


def _signed(value: float) -> str:
    return f"{round(value, 2) + 0.0:+.2f}"  # + 0.0: no minus before a zero
