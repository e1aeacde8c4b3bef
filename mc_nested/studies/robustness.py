"""The paper's experiment again under each of its open choices, one at a time, by all three agents (robustness.toml)."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import Preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.change import Change, shipped_changes
from mc_nested.studies.claim_text import found_of, row_of
from mc_nested.studies.claims.judge import judge
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.inference import ALPHA
from mc_nested.studies.results import Results, results_of
from mc_nested.studies.study import Report, Study, StudyOptions
from mc_nested.studies.table import Table, markdown, mean, number_of_trials, table_of
from mc_nested.studies.trial import Trial
from mc_nested.studies.verdicts import JudgedClaim, Verdict

LEFT_OUT = "f"
"""The claim that is not judged again: of a longer training."""


def arms(options: StudyOptions) -> list[Arm]:
    """Return all agents under each choice, the base first."""
    preset = options.loaded_preset()
    return [
        choice.arm(f"{choice.name}, {agent}", agent, options, preset)
        for choice in open_choices(preset, options.scenarios)
        for agent in AGENT_SPECS
    ]


def open_choices(preset: Preset, scenarios: Sequence[Scenario]) -> list[Change]:
    """Return the base, and the shipped choices that change anything with this preset and these designs."""
    shipped = shipped_changes("robustness.toml")
    return [Change(), *(choice for choice in shipped if choice.differs(list(AGENT_SPECS), preset, scenarios))]


@dataclass(frozen=True)
class JudgedChoice:
    """The claims under one choice; an empty choice is the base."""

    choice: str
    value: str
    results: Results
    claims: tuple[JudgedClaim, ...]

    @property
    def name(self) -> str:
        """A name that no other choice has."""
        return f"{self.choice}: {self.value}" if self.choice else "as it is"

    @property
    def verdicts(self) -> Mapping[str, Verdict]:
        """By the claim's letter."""
        return {judged.claim.letter: judged.verdict for judged in self.claims}


def judged_under(choice: str, value: str, results: Results) -> JudgedChoice:
    """Judge the results under a choice."""
    claims = tuple(judged for judged in judge(results) if judged.claim.letter != LEFT_OUT)
    return JudgedChoice(choice, value, results, claims)


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report the verdicts under each choice."""
    by_choice: dict[tuple[str, str], list[Trial]] = {}
    for trial in trials:
        by_choice.setdefault((trial.arm.labels["choice"], trial.arm.labels["value"]), []).append(trial)
    return report_on([judged_under(*choice, results_of(own, config.seed)) for choice, own in by_choice.items()])


LEGEND = """\
Each line is the paper's experiment with one choice made otherwise, for all three agents. **Bold** where the verdict is
not that of the first line. Every claim is judged as in the report of `mc-nested reproduce`, at α = {alpha:g}, each line
by itself: of so many verdicts some differ by chance alone. Undecided means that these trials don't show it.

Not judged: claim (f), which takes longer trainings. Not varied, since no
preset or scenario says otherwise: r_N and r_M, the order of a move and its block, what stops a walker, the single
agent's later choices, the optimiser, the linear output, the initial weights, and that truncation bootstraps."""

EACH = "for each choice, agent and scenario"


def report_on(choices: Sequence[JudgedChoice]) -> Report:
    """Return the report of the judged choices, the base first."""
    results = choices[0].results
    trials = number_of_trials(results.trials)
    return Report(
        text=[
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
        ],
        figure=_figure(choices),
        tables={"robustness.csv": _findings(choices)},
        found={
            "claims": [
                {
                    **found_of(base),
                    "choices": {each.name: each.verdicts[base.claim.letter].value for each in choices[1:]},
                }
                for base in choices[0].claims
            ]
        },
        shown=_shown(choices),
    )


def _findings(choices: Sequence[JudgedChoice]) -> Table:
    """Return the table of every line of every claim under every choice."""
    rows = []
    for each in choices:
        for judged in each.claims:
            for finding in judged.findings:
                evidence, tails = finding.evidence, finding.evidence.tails
                measured = evidence.figures[-1][1] if evidence.figures else ""
                own = (tails.claim, tails.against, finding.against, finding.small) if tails else ("",) * 4
                of = {"choice": each.choice, "value": each.value, "claim": judged.claim.letter, "line": evidence.what}
                p_values = dict(zip(("p", "p_opposite", "p_opposite_holm", "p_small"), own, strict=True))
                rows.append({**of, "measured": measured, **p_values, "verdict": finding.verdict.value})
    return table_of(rows)


def _shown(choices: Sequence[JudgedChoice]) -> Table:
    rows = []
    for base in choices[0].claims:
        counted = Counter(each.verdicts[base.claim.letter].value for each in choices[1:])
        others = ", ".join(f"{count} {verdict}" for verdict, count in sorted(counted.items()))
        rows.append((*row_of(base), others))
    return Table(("", "the paper's claim", "as it is", "under the other choices"), rows)


def _verdicts(choices: Sequence[JudgedChoice]) -> str:
    base = choices[0].verdicts
    rows = [
        (each.name, *(_verdict(verdict, base[letter]) for letter, verdict in each.verdicts.items())) for each in choices
    ]
    return markdown(("choice", *(f"({letter})" for letter in base)), rows)


def _verdict(verdict: Verdict, base: Verdict) -> str:
    return verdict.value if verdict is base else f"**{verdict.value}**"


def _claims(choices: Sequence[JudgedChoice]) -> str:
    rows = []
    for judged in choices[0].claims:
        letter = judged.claim.letter
        others = [each.verdicts[letter] for each in choices[1:]]
        counts = (str(others.count(verdict)) for verdict in Verdict)
        rows.append((f"({letter})", judged.claim.title, judged.verdict.value, *counts))
    return markdown(("claim", "", "as it is", *(f"otherwise: {verdict.value}" for verdict in Verdict)), rows)


def _scores(choices: Sequence[JudgedChoice]) -> str:
    rows = []
    for each in choices:
        curves = each.results.curves
        cells = [
            ", ".join(mean(curves[agent, scenario].last_ten) for agent in each.results.agents)
            + f" of {each.results.optimum[scenario]:g}"
            for scenario in each.results.scenarios
        ]
        rows.append((each.name, *cells))
    return markdown(("choice", *choices[0].results.scenarios), rows)


LOOKS = {
    Verdict.HOLDS: ("#009E73", "✓"),
    Verdict.SLIGHTLY: ("#8FD5C0", "✓"),
    Verdict.UNDECIDED: ("#DDDDDD", ""),
    Verdict.FAILS: ("#D55E00", "✗"),
    Verdict.NOT_JUDGED: ("white", ""),
}
"""Okabe and Ito's colours, and a sign for whoever can't tell them apart."""


def _figure(choices: Sequence[JudgedChoice]) -> Figure:
    """Draw a grid of verdicts, a line for each choice and a column for each claim; the base is the line on top."""
    letters = list(choices[0].verdicts)
    size = (3.6 + 0.5 * len(letters), 1.6 + 0.3 * len(choices))
    figure = Figure(figsize=size, dpi=140, layout="constrained")
    axes = figure.subplots()
    for row, each in enumerate(choices):
        for column, letter in enumerate(letters):
            _draw_cell(axes, column, row, each.verdicts[letter])
    axes.set_xlim(-0.5, len(letters) - 0.5)
    axes.set_ylim(len(choices) - 0.5, -0.5)
    axes.set_xticks(range(len(letters)), [f"({letter})" for letter in letters])
    axes.set_yticks(range(len(choices)), [each.name for each in choices], parse_math=False)
    axes.axhline(0.5, color="black", linewidth=1.4)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    legend = [Patch(facecolor=LOOKS[verdict][0], edgecolor="grey", label=verdict.value) for verdict in LOOKS]
    figure.legend(handles=legend, loc="outside lower center", ncols=len(legend), frameon=False)
    return figure


def _draw_cell(axes: Axes, column: int, row: int, verdict: Verdict) -> None:
    color, sign = LOOKS[verdict]
    axes.add_patch(Rectangle((column - 0.5, row - 0.5), 1, 1, facecolor=color, edgecolor="white", linewidth=1.5))
    axes.text(column, row, sign, ha="center", va="center", fontsize=9)


STUDY = Study(
    name="robustness",
    what="Judge the paper's claims again under each of its open choices. The defaults take about an hour on two cores.",
    options={
        "trials": 10,
        "episodes": None,
        "seed": 0,
        "scenario": None,
        "layer": None,
        "preset": "paper",
        "engine": None,
        "device": None,
    },
    arms=arms,
    report=report,
    files={"table": "robustness.md", "plot": "robustness.png", "rows": "robustness.csv"},
)
