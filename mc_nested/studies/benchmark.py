"""The benchmark: every contestant, an agent with a preset, on every design of a corpus; a trial ends at the optimum."""

import dataclasses
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import PercentFormatter, StrMethodFormatter

from mc_nested.arena.design import CORNER, EDGE, KINDS, SCATTERED, kind_of_design, load_corpus, random_scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arrays import Float64s, Int64s
from mc_nested.errors import PresetError, UserError
from mc_nested.learn.agents import AGENT_SPECS, check_exploration
from mc_nested.learn.preset import Preset, load_preset, parse_preset
from mc_nested.learn.unknown_design import playing
from mc_nested.studies.arm import AGENTS, LIBRARY, SB3, Arm
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.profiles import Measures, PlayedDesigns, measures_of, played_designs, profile, profile_band
from mc_nested.studies.sb3 import HOW_TO_INSTALL, is_installed
from mc_nested.studies.study import Report, Study, StudyOptions
from mc_nested.studies.table import markdown_of, number_of_trials, table_of
from mc_nested.studies.trial import Trial, trial_table

BASELINE, SB3_PRESET = "baseline.toml", "dqn"
"""What stands for a preset beside stable-baselines3's agent, and its name."""

DEFAULT_AGENTS, DEFAULT_PRESETS = ("nested", SB3), ("model-based", "tuned", "paper")

LIKE = "line"
"""The shipped design whose start cell and materials every design of a benchmark has."""

COLUMNS = (
    "agent",
    "preset",
    "design",
    "kind",
    "blocks",
    "trial",
    "optimum",
    "best_score",
    "played_to_optimum",
    "without_a_prior",
    "updates",
)


def arms(options: StudyOptions) -> list[Arm]:
    """Return every agent with every preset that it can take, on every design; sb3's trials train one by one."""
    if options.corpus is not None and "designs" in options.given:
        raise UserError("--designs is how many are drawn at random: leave it out, or leave out --corpus")
    chosen = [(name, load_preset(name)) for name in options.presets or DEFAULT_PRESETS]
    contestants, left_out = contestants_of(_agents(options), chosen)
    for line in left_out:
        options.say(line)
    like = load_scenario(LIKE)
    if options.corpus is None:
        scenarios = [random_scenario(options.seed, number, like) for number in range(options.designs)]
    else:
        scenarios = load_corpus(options.corpus, like)
    return [
        Arm(
            name=f"{agent}, {Path(name).stem}",
            agent=agent,
            preset=preset,
            preset_name=name,
            scenarios=scenarios,
            trials=options.trials,
            stop_at_optimum=True,
            differs_by_design=True,
            together=1 if agent == SB3 else options.trials,
        )
        for agent, name, preset in contestants
    ]


def _agents(options: StudyOptions) -> list[str]:
    """Return the agents; UserError if one doesn't exist, or can't take part as it was asked for."""
    for name in options.agents:
        if name not in AGENTS:
            raise UserError(f"no agent {name!r}: choose of {', '.join(AGENTS)}")
    if SB3 in options.agents and not is_installed():
        raise UserError(f"{LIBRARY} isn't installed: {HOW_TO_INSTALL}, or leave {SB3} out of --agents")
    if list(options.agents) == [SB3] and options.presets:
        raise UserError(f"{SB3} takes no preset: leave out --presets, or name another agent, too")
    if options.agents:
        return list(options.agents)
    if is_installed():
        return list(DEFAULT_AGENTS)
    options.say(f"{SB3} is left out, since {LIBRARY} isn't installed: {HOW_TO_INSTALL}")
    return [name for name in DEFAULT_AGENTS if name != SB3]


def baseline() -> Preset:
    """Return what stands for a preset beside stable-baselines3's DQN."""
    return parse_preset((resources.files("mc_nested.studies") / BASELINE).read_text("utf-8"), BASELINE)


Contestant = tuple[str, str, Preset]
"""An agent, its preset's name and the preset."""


def contestants_of(agents: Sequence[str], presets: Sequence[tuple[str, Preset]]) -> tuple[list[Contestant], list[str]]:
    """Return every agent with every preset that it can take, sb3 with its own; and a line for each that it can't take.

    UserError if an agent can take none of them.
    """
    found: list[Contestant] = []
    left_out: list[str] = []
    for agent in agents:
        if agent == SB3:
            found.append((SB3, SB3_PRESET, baseline()))
            continue
        reasons = {name: _reason_against(agent, preset) for name, preset in presets}
        if all(reasons.values()):
            raise UserError(f"{agent} can't take {' or '.join(reasons)}: {next(iter(reasons.values()))}")
        # Nobody tells a contestant its design: the agent with objectives finds it out.
        can = [
            (name, playing(preset) if preset.objectives else preset) for name, preset in presets if not reasons[name]
        ]
        found += [(agent, name, preset) for name, preset in can]
        left_out += [f"{agent} with {name} is left out: {reason}" for name, reason in reasons.items() if reason]
    return found, left_out


def _reason_against(agent: str, preset: Preset) -> str:
    """Return why the agent can't take the preset; empty if it can."""
    try:
        check_exploration(AGENT_SPECS[agent], preset)
    except PresetError as error:
        return str(error)
    return ""


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


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report a table over all designs, and one for each kind; repeated, the line of seconds alone differs."""
    contestants: dict[str, list[Trial]] = {}
    for trial in trials:
        contestants.setdefault(trial.arm.name, []).append(trial)
    overall = [(name, measures_of(played_designs(own))) for name, own in contestants.items()]
    shown = [{"episodes to the optimum": name, **dict(own.in_words())} for name, own in overall]
    return Report(
        text=_text(config, contestants, overall),
        figure=_figure(contestants),
        tables={"benchmark.csv": trial_table(trials, COLUMNS)},
        found={"measures": [{"contestant": name, **dataclasses.asdict(own)} for name, own in overall]},
        shown=table_of(shown),
    )


def _text(
    config: StudyConfig, contestants: Mapping[str, Sequence[Trial]], overall: Sequence[tuple[str, Measures]]
) -> list[str]:
    designs = {trial.scenario.name: trial.scenario for own in contestants.values() for trial in own}
    corpus = config.notes.get("corpus")
    origin = f"of `{corpus}`" if corpus else f"drawn from seed {config.seed}"
    blocks = [scenario.blocks for scenario in designs.values()]
    sizes = f"{min(blocks)} to {max(blocks)}" if min(blocks) < max(blocks) else f"{blocks[0]}"
    of_each = number_of_trials(config.trials).capitalize()
    parts = [
        "# Episodes to the optimum on designs that nobody tuned on",
        f"{_designs(len(designs))} of {sizes} blocks {origin}. {of_each} on each, seed {config.seed}.",
        "![Share of trials solved within a number of episodes; episodes on each kind of designs](benchmark.png)",
        _table(contestants, overall),
    ]
    kinds = [kind_of_design(scenario.design) for scenario in designs.values()]
    for kind in KINDS:
        if 0 < kinds.count(kind) < len(designs):
            own = [(name, measures_of(played_designs(each, kind))) for name, each in contestants.items()]
            heading = f"## {kind}: {WHAT_KINDS_ARE[kind]} ({_designs(kinds.count(kind))})"
            parts += [heading, _table(contestants, own)]
    updates = {name: [trial.outcome.updates for trial in own] for name, own in contestants.items()}
    seconds = {name: [trial.seconds for trial in own] for name, own in contestants.items()}
    said = [f"{name} {median(own):.1f} (at most {max(own):.1f})" for name, own in seconds.items()]
    return [
        *parts,
        LEGEND.replace("\n", " "),
        "Updates of a trial, median: " + "; ".join(f"{name} {median(own):,.0f}" for name, own in updates.items()) + ".",
        "Seconds of one core a trial, median: " + "; ".join(said) + ".",
    ]


def _designs(number: int) -> str:
    return f"{number} designs" if number > 1 else "one design"


def _table(contestants: Mapping[str, Sequence[Trial]], found: Sequence[tuple[str, Measures]]) -> str:
    given_up = {name: f"{own[0].arm.preset.episodes:,}" for name, own in contestants.items()}
    return markdown_of(
        [[("agent, preset", name), *own.in_words(), ("given up after", given_up[name])] for name, own in found]
    )


COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito's, distinguishable with any colour vision."""

LINES: Sequence[Any] = ("-", (0, (4, 1.5)), (0, (1, 1.5)))
"""The next line style begins where the colours are used up."""

BAND = 0.15
"""Opacity of the intervals."""

POINTS = 200
"""Numbers of episodes at which profiles are drawn, at most."""

ROOM = 1.2
"""How far a profile goes on after the longest trial, as a factor."""

NEVER = 1.6
"""How far above the longest trial the line for "never" stands, as a factor."""


def _figure(contestants: Mapping[str, Sequence[Trial]]) -> Figure:
    """Draw the performance profiles, and beside them the episodes on each kind of designs."""
    styles = {
        name: {"color": COLOURS[place % len(COLOURS)], "linestyle": LINES[place // len(COLOURS) % len(LINES)]}
        for place, name in enumerate(contestants)
    }
    solved = [trial.played_to_optimum for own in contestants.values() for trial in own]
    longest = max([10, *(played for played in solved if played is not None)])
    figure = Figure(figsize=(11.5, 4.6), dpi=140, layout="constrained")
    left, right = figure.subplots(1, 2)
    _draw_profiles(left, {name: played_designs(own) for name, own in contestants.items()}, ROOM * longest, styles)
    _draw_kinds(right, contestants, NEVER * longest, styles)
    for axes in (left, right):
        axes.grid(alpha=0.2)
        axes.spines[["top", "right"]].set_visible(False)
    shown: dict[str, Any] = {"linewidth": 1.7, "marker": "o", "markersize": 5}
    legend = [
        *(Line2D([], [], label=name, **shown, **style) for name, style in styles.items()),
        Line2D([], [], color="black", linewidth=1.2, label="without a prior, in theory"),
    ]
    figure.legend(handles=legend, loc="outside lower center", ncols=5, frameon=False)
    return figure


def _draw_profiles(
    axes: Axes, played: Mapping[str, PlayedDesigns], most: float, styles: Mapping[str, dict[str, Any]]
) -> None:
    episodes: Int64s = np.unique(np.geomspace(1, most, POINTS).astype(np.int64))
    for name, style in styles.items():
        trials = played[name]
        band = profile_band(trials, episodes)
        if band:
            axes.fill_between(episodes, *band, color=style["color"], alpha=BAND, linewidth=0, step="post")
        axes.step(episodes, profile(trials.played, episodes), where="post", linewidth=1.7, **style)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.set_xlim(1, most)
    axes.set_ylim(0, 1.02)
    axes.set_title("Trials solved within a number of episodes", loc="left")
    axes.set_xlabel("episodes played, greedy ones included")


def _draw_kinds(
    axes: Axes, contestants: Mapping[str, Sequence[Trial]], never: float, styles: Mapping[str, dict[str, Any]]
) -> None:
    there = {kind_of_design(trial.scenario.design) for own in contestants.values() for trial in own}
    kinds = [kind for kind in KINDS if kind in there]
    apart = 0.7 / len(styles)
    for place, kind in enumerate(kinds):
        should: Float64s = np.array([])
        for number, (name, style) in enumerate(styles.items()):
            trials = played_designs(contestants[name], kind)
            should = trials.without_a_prior
            x = place + apart * (number - (len(styles) - 1) / 2)
            low, middle, high = np.minimum(_quartiles(trials.played), never)
            axes.plot([x, x], [low, high], linewidth=5, alpha=0.35, solid_capstyle="butt", color=style["color"])
            axes.plot([x], [middle], marker="o", markersize=6, color=style["color"], clip_on=False)
        axes.plot([place - 0.42, place + 0.42], [np.median(should)] * 2, color="black", linewidth=1.2)
    axes.axhline(never, color="black", linewidth=0.8, linestyle=(0, (1, 3)))
    axes.set_yscale("log")
    axes.set_ylim(1, never)
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.text(1.0, 1.01, "never solved", transform=axes.transAxes, ha="right", va="bottom", fontsize=9)
    axes.set_xticks(range(len(kinds)), kinds)
    axes.set_xlim(-0.5, len(kinds) - 0.5)
    axes.set_title("Episodes to the optimum: median, middle half", loc="left")
    axes.set_xlabel("how a design's blocks hang together")


def _quartiles(played: Float64s) -> Float64s:
    """Return the first quartile, the median and the third quartile; an infinite one if its trial is."""
    ordered = np.sort(played, axis=None)
    low, high = (ordered[round(share * (len(ordered) - 1))] for share in (0.25, 0.75))
    return np.array([low, np.median(ordered), high])


STUDY = Study(
    name="benchmark",
    what="Count the episodes to the optimum on many designs. sb3 is stable-baselines3's DQN, for comparison.",
    options={"designs": 100, "corpus": None, "agents": None, "presets": None, "trials": 1, "seed": 0},
    arms=arms,
    report=report,
    files={"report": "benchmark.md", "plot": "benchmark.png", "rows": "benchmark.csv"},
    notes=lambda options: {"corpus": options.corpus.name} if options.corpus else {},
)
