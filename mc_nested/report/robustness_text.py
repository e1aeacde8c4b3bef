"""robustness.md: a table of verdicts, a line for each choice and a column for each claim."""

from collections.abc import Sequence

from mc_nested.report.inference import ALPHA
from mc_nested.report.markdown import mean, table
from mc_nested.report.measures import curves_of
from mc_nested.report.robustness_results import JudgedChoice
from mc_nested.report.verdicts import Verdict

LEGEND = """\
Each line is the paper's experiment with one choice made otherwise, for all three agents. **Bold** where the verdict is
not that of the first line. Every claim is judged as in the report of `mc-nested reproduce`, at α = {alpha:g}, each line
by itself: of so many verdicts some differ by chance alone. Undecided means that these trials don't show it.

Not judged: claim (f), which takes longer trainings, and (i), seconds, which many choices share. Not varied, since no
preset or scenario says otherwise: r_N and r_M, the order of a move and its block, what stops a walker, the single
agent's later choices, the optimiser, the linear output, the initial weights, and that truncation bootstraps."""


EACH = "for each choice, agent and scenario"


def robustness_text(choices: Sequence[JudgedChoice]) -> str:
    """The report as Markdown, of the base and at least no other choice; the same results give the same text."""
    results = choices[0].results
    trials = f"{results.trials} trials" if results.trials > 1 else "one trial"
    parts = [
        "# The verdicts under the paper's open choices",
        f"Preset `{results.preset}`, seed {results.seed}: {trials} of {results.episodes:,} episodes {EACH}.",
        "![Verdicts, a line for each choice, a column for each claim](robustness.png)",
        _verdicts(choices),
        LEGEND.format(alpha=ALPHA),
        "## The claims",
        _claims(choices),
        "## Scores",
        _scores(choices),
        f"Means over the trials of the mean of the last ten evaluations: {', '.join(results.agents)}.",
    ]
    return "\n\n".join(parts) + "\n"


def _verdicts(choices: Sequence[JudgedChoice]) -> str:
    base = choices[0].verdicts
    rows = [
        (each.name, *(_verdict(verdict, base[letter]) for letter, verdict in each.verdicts.items())) for each in choices
    ]
    return table(("choice", *(f"({letter})" for letter in base)), rows)


def _verdict(verdict: Verdict, base: Verdict) -> str:
    return verdict.value if verdict is base else f"**{verdict.value}**"


def _claims(choices: Sequence[JudgedChoice]) -> str:
    rows = []
    for judged in choices[0].claims:
        letter = judged.claim.letter
        others = [each.verdicts[letter] for each in choices[1:]]
        counts = (str(others.count(verdict)) for verdict in (Verdict.HOLDS, Verdict.UNDECIDED, Verdict.FAILS))
        rows.append((f"({letter})", judged.claim.title, judged.verdict.value, *counts))
    return table(("claim", "", "as it is", "otherwise: holds", "undecided", "does not hold"), rows)


def _scores(choices: Sequence[JudgedChoice]) -> str:
    rows = []
    for each in choices:
        curves = curves_of(each.results)
        cells = [
            ", ".join(mean(curves[agent, scenario].last_ten) for agent in each.results.agents)
            + f" of {each.results.optimum[scenario]:g}"
            for scenario in each.results.scenarios
        ]
        rows.append((each.name, *cells))
    return table(("choice", *choices[0].results.scenarios), rows)
