"""What the paper says it could do and didn't try: images, several main actions, many of them, cooperation."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from mc_nested.arena.cooperative.team import MOST_BUILDERS
from mc_nested.arena.scenario import Material, Scenario
from mc_nested.arena.scenario_file import load_scenario, paper_scenarios
from mc_nested.arrays import Float64s
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond_figure import beyond_figure, objectives_figure
from mc_nested.studies.claim_text import claim_section, found_of, method, row_of
from mc_nested.studies.claims.arm_results import ArmResults, Arms
from mc_nested.studies.claims.beyond import equal_budget, judge_beyond, of_topic
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.inference import ALPHA, share_interval
from mc_nested.studies.power import MOST_TRIALS, POWER, deciding_trials
from mc_nested.studies.reproduce import cost_cells
from mc_nested.studies.results import cost_of
from mc_nested.studies.study import Report, Study, StudyOptions, with_episodes
from mc_nested.studies.table import (
    NONE,
    Cells,
    Table,
    interval,
    interval_of_mean,
    markdown,
    markdown_of,
    mean,
    number_of_trials,
)
from mc_nested.studies.trial import Trial, greedy_table, on_each
from mc_nested.studies.verdicts import JudgedClaim

FEW = 3
"""Trials of images on the zigzag and the diamond, which take long."""

TEAM_EPISODES = 1500
"""Training episodes of a team."""

COUNTS = (2, 4, 8)
"""Numbers of main actions that are compared."""

TOGETHER = 5
"""Trials that train as one job: the same however many processes there are, so that seconds can be compared."""

NAMES = ("wood", "dirt", "clay", "glass", "sandstone", "cobblestone", "bricks", "stone")
BLOCKS = ("oak_planks", "dirt", "clay", "glass", "sandstone", "cobblestone", "bricks", "stone")
"""The most materials of the family; wood and stone are the paper's."""

TEAMS: list[tuple[int, Networks]] = [
    (1, "shared"),
    *((count, kind) for count in range(2, MOST_BUILDERS + 1) for kind in NETWORKS),
]
"""Numbers of builders, and how they learn."""

TUNED = "nested, tuned"
"""The nested agent with settings that solve the flag."""


def team_name(builders: int, networks: Networks) -> str:
    """Return the name of a team's arm."""
    return "1 builder" if builders == 1 else f"{builders} builders, {networks}"


def arms(options: StudyOptions) -> list[Arm]:
    """Return all arms; of images on the zigzag and the diamond only a few trials, unless so many were asked for.

    No training has more episodes than were asked for, and some have fewer. PresetError if the device isn't there.
    """
    image, tuned, paper = (load_preset(name) for name in ("image", "tuned", "paper"))
    few = options.trials if "trials" in options.given else min(FEW, options.trials)
    found = [
        *_images(image.changed(device=options.device), paper, options.trials, few),
        *_parts(paper, tuned, options.trials),
        *_materials(paper, options.trials),
        *_cooperation(paper, options.trials),
    ]
    most = options.episodes
    return [
        replace(arm, preset=with_episodes(arm.preset, min(most, arm.preset.episodes))) if most else arm for arm in found
    ]


def arm_of(topic: str, name: str, preset: Preset, scenarios: Sequence[Scenario], trials: int, **more: Any) -> Arm:
    """Return an arm of a topic; ``more`` are further fields of it."""
    labels = {"topic": topic, "agent": name}
    return Arm(f"{topic}: {name}", preset, scenarios, trials, labels=labels, together=TOGETHER, **more)


def _images(image: Preset, paper: Preset, trials: int, few: int) -> list[Arm]:
    """Return images, and beside them numbered states: the preset paper, exploring as the preset image here."""
    numbers = paper.model_copy(update={"explore_main": image.explore_main, "explore_nested": image.explore_nested})
    return [
        arm_of("images", name, preset, [load_scenario(design)], own, preset_name=preset_name, stop_at_optimum=True)
        for design in paper_scenarios()
        for own in [trials if design == "line" else few]
        for name, preset_name, preset in (("images", "image", image), ("numbers", "paper", numbers))
    ]


def _parts(paper: Preset, tuned: Preset, trials: int) -> list[Arm]:
    """Return the paper's agents on the flag, and the nested one with settings that solve it."""
    flag = [load_scenario("flag")]
    solved = arm_of("parts", TUNED, tuned, flag, trials, preset_name="tuned", stop_at_optimum=True)
    return [solved, *(arm_of("parts", agent, paper, flag, trials, agent=agent) for agent in AGENT_SPECS)]


def _materials(paper: Preset, trials: int) -> list[Arm]:
    line = load_scenario("line")
    return [
        arm_of("materials", agent, paper, [with_materials(line, count)], trials, agent=agent)
        for count in COUNTS
        for agent in AGENT_SPECS
    ]


def _cooperation(paper: Preset, trials: int) -> list[Arm]:
    """Return builders on the line: one alone, and two to four, learning in each way."""
    line, preset = [load_scenario("line")], with_episodes(paper, TEAM_EPISODES)
    return [
        arm_of("cooperation", team_name(count, kind), preset, line, trials, builders=count, networks=kind)
        for count, kind in TEAMS
    ]


def with_materials(scenario: Scenario, count: int) -> Scenario:
    """Return the scenario with 2 to 8 materials, whose p are evenly spaced between its own lowest and highest.

    The worst comes first and the best last, as in the paper's: its optimum is the same, whatever their number.
    """
    worths = [material.p for material in scenario.materials]
    low, high = min(worths), max(worths)
    chosen = [number * (len(NAMES) - 1) // (count - 1) for number in range(count)]
    materials = tuple(
        Material(NAMES[index], low + (high - low) * number / (count - 1), BLOCKS[index])
        for number, index in enumerate(chosen)
    )
    return replace(scenario, name=f"{scenario.name}, {count} materials", materials=materials)


TOPICS = {
    "images": "Images",
    "parts": "Several main actions",
    "materials": "Many main actions",
    "cooperation": "Cooperating nested agents",
    "objectives": "Many main actions, as objectives",
}

LETTERS = {"images": "j", "parts": "k", "materials": "l", "cooperation": "m", "objectives": "n"}
"""What the letters of a topic's claims begin with."""

ABOUT = {
    "images": "The nested agent sees the arena from above, as planes, through a convolution (preset `image`). Beside "
    "it the preset `paper`, which sees numbers, and explores for as long as `image` does. A trial ends at its first "
    'greedy episode at the optimum. The states "screen" are not among these: they need a game\'s window.',
    "parts": "The main agent chooses a material before each of the design's parts. The arm `nested, tuned` ends each "
    "trial at its first greedy episode at the optimum; the other agents have the preset `paper`.",
    "materials": "One design, with 2, 4 and 8 materials, whose p are evenly spaced between the paper's two: the "
    "optimum is the same. Every agent does one update for each step that it trains, and its main agent one for each "
    "episode: so equal steps are nearly equal updates. Below, scores within what every trial of all nine had spent in "
    "the end; the claims compare two agents each, within what both had spent.",
    "cooperation": "Several builders in one arena, preset `paper`, with half its episodes. shared: one nested agent "
    "plays all of them; own: each has one; single: independent single agents. An episode of several builders is "
    "shorter, since they share the blocks.",
    "objectives": "One design, and the arena in 2, 4, 16, 64 and 225 regions: halves, quarters, 4 x 4, 8 x 8, cells. "
    "The main agent chooses a region to build in, again after each block and after some steps without "
    "one. r_N is 1 for a block on the design in that region, r_M is the blocks on the design. The single agent is paid "
    "r_M, as ever: a choice costs it a step and brings nothing, but the first action of an episode has to be one. "
    "Preset `paper`, with an input for each value of x, y, b and a_M. Every agent does one update for each step that "
    "it trains, and its main agent one for each choice. Below, scores within what every trial of all fifteen had spent "
    "in the end; the claims compare two agents each, within what both had spent.",
}

MORE = """\
- The trials that would decide a claim are so many that its tests would decide it with a power of {power:g}, if means,
  spreads and shares were what these trials had: all lines shown, or the opposite of one, at α divided by the number of
  lines. An estimate from few trials is rough, and so is this."""


COLUMNS = ("topic", "scenario", "agent", "trial", "episode", "score", "material", "steps", "trained_steps", "updates")


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report what was trained, the claims with their verdicts, and how many trials would decide each."""
    arms = {each.key: each for each in map(ArmResults, on_each(trials).values())}
    return report_on(config.study, arms, config.trials, config.seed)


def report_on(study: str, arms: Arms, trials: int, seed: int) -> Report:
    """Return that study's report on these arms; the same of the same results, but for the column of seconds."""
    claims, (title, shows, draw) = judge_beyond(arms), REPORTS[study]
    rows = [(*row_of(each), in_words(each)) for each in claims]
    header = ("claim", "", f"verdict at α = {ALPHA:g}", f"trials that would decide it, power {POWER:g}")
    text = [
        f"# {title}",
        f"Seed {seed}: {number_of_trials(trials)} of each agent, where the tables don't say otherwise.",
        f"![{shows}]({study}.png)",
        markdown(header, [(*about, f"**{words}**", needed) for *about, words, needed in rows]),
    ]
    for topic, heading in TOPICS.items():
        if not (own := of_topic(arms, topic)):
            continue
        text += [f"## {heading}", ABOUT[topic], *_too_few(own), _scores(own), *_more(own, topic)]
        text += [claim_section(each) for each in claims if each.claim.letter.startswith(LETTERS[topic])]
    text += ["## How it was computed", method(claims, trials, keeps_best=False), MORE.format(power=POWER)]
    every = [trial for each in arms.values() for trial in each.trials]
    return Report(
        text=text,
        figure=draw(arms),
        tables={f"{study}.csv": greedy_table(every, COLUMNS)},
        found={"claims": [{**found_of(each), "trials": trials_to_decide(each)} for each in claims]},
        shown=Table(("", "what the paper says it could do", "verdict", "trials to decide it"), rows),
    )


def trials_to_decide(judged: JudgedClaim) -> int | None:
    """Return how many trials of each agent would decide it; None if more than MOST_TRIALS, or it is counted."""
    return deciding_trials([line.effect for line in judged.claim.evidence if line.effect])


def in_words(judged: JudgedClaim) -> str:
    """Say the same to a reader."""
    if not any(line.tails for line in judged.claim.evidence):
        return NONE
    found = trials_to_decide(judged)
    return f"more than {MOST_TRIALS:,}" if found is None else str(found)


def _too_few(arms: Sequence[ArmResults]) -> list[str]:
    """Return what so few trials can't show, where an arm has fewer than the binomial test needs."""
    few = min(len(arm.trials) for arm in arms)
    if few == max(len(arm.trials) for arm in arms) or 0.5**few < ALPHA:
        return []
    return [f"{few} trials are too few for any test: a claim with a line of so few stays undecided."]


def _scores(arms: Sequence[ArmResults]) -> str:
    rows = [
        (
            ("scenario", arm.scenario),
            ("agent", arm.name),
            ("trials", str(len(arm.trials))),
            ("episodes at most", f"{arm.arm.preset.episodes:,}"),
            *_mean_and_interval("last ten", None if arm.stops else arm.last_ten, arm.optimum),
            *_mean_and_interval("best", arm.best, arm.optimum),
            *_reached(arm),
        )
        for arm in arms
    ]
    optimum = ", ".join(dict.fromkeys(f"{arm.scenario} {arm.optimum:g}" for arm in arms))
    ends = " A trial that ends at the optimum has no last ten." if any(arm.stops for arm in arms) else ""
    return f"{markdown_of(rows)}\n\nOptimum: {optimum}.{ends}"


def _mean_and_interval(of: str, trials: Float64s | None, optimum: float) -> Cells:
    found = (NONE, NONE) if trials is None else (mean(trials), interval_of_mean(trials, optimum))
    return [(of, found[0]), ("95 % interval", found[1])]


def _reached(arm: ArmResults) -> Cells:
    until = [trial.episodes_to_optimum for trial in arm.trials]
    reached = [episode for episode in until if episode is not None]
    return [
        ("trials that reached the optimum", f"{len(reached)} of {len(arm.trials)}"),
        ("95 % interval of the share", interval(share_interval(len(reached), len(arm.trials)))),
        ("episodes before, median", f"{np.median(reached):g}" if reached else NONE),
    ]


def _more(own: Sequence[ArmResults], topic: str) -> list[str]:
    """Return a topic's further tables: of many main actions, scores at equal steps and updates, and costs."""
    if topic not in ("materials", "objectives"):
        return []
    steps, updates = equal_budget(own, "steps"), equal_budget(own, "updates")
    rows = [
        (
            ("main actions", str(arm.materials)),
            ("agent", arm.name),
            *_mean_and_interval(f"last ten until {steps:,} steps", arm.within(steps, "steps"), arm.optimum),
            *_mean_and_interval(f"last ten until {updates:,} updates", arm.within(updates, "updates"), arm.optimum),
            ("early", mean(arm.early(steps, "steps"))),
            *cost_cells(cost),
            ("seconds of a core, all trials", f"{cost.seconds:.1f}"),
        )
        for arm in own
        for cost in [cost_of(arm.trials)]
    ]
    early = (
        f"Early: the mean over a trial's evaluations until {steps // 3:,} steps. Seconds are of the whole training, "
        "the simulator too; another run won't repeat them."
    )
    return [f"{markdown_of(rows)}\n\n{early}"]


REPORTS: Mapping[str, tuple[str, str, Callable[[Arms], Figure]]] = {
    "beyond": (
        "Beyond the paper: what it says it could do, tried",
        "Images, parts, many main actions and cooperation",
        beyond_figure,
    ),
    "objectives": (
        "Many main actions: objectives",
        "Scores and parameters of three agents with 2 to 225 main actions",
        objectives_figure,
    ),
}
"""Of each study that is reported like this: its heading, what its figure shows, and what draws it."""

STUDY = Study(
    name="beyond",
    what="Try what the paper says it could do: images, several and many main actions, teams. The defaults take about "
    "an hour on two cores.",
    options={"trials": 10, "episodes": None, "seed": 0, "device": None},
    arms=arms,
    report=report,
    files={"report": "beyond.md", "plot": "beyond.png", "rows": "beyond.csv"},
)
