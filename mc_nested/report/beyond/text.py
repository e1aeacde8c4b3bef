"""beyond.md: what was trained, the claims with their verdicts, and how many trials would decide each."""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.report.beyond.arms import ArmResults, Arms
from mc_nested.report.beyond.claims import equal_budget, of_topic
from mc_nested.report.claim_text import claim_section, method
from mc_nested.report.claims.costs import MEGA
from mc_nested.report.inference import ALPHA, mean_interval, share_interval
from mc_nested.report.markdown import NONE, interval, mean, table
from mc_nested.report.power import MOST_TRIALS, POWER, deciding_trials
from mc_nested.report.verdicts import JudgedClaim

TOPICS = {
    "images": "Images",
    "parts": "Several main actions",
    "materials": "Many main actions",
    "cooperation": "Cooperating nested agents",
}

LETTERS = {"images": "j", "parts": "k", "materials": "l", "cooperation": "m"}
"""What the letters of a topic's claims begin with."""

ABOUT = {
    "images": "The nested agent sees the arena from above, as planes, through a convolution (preset `image`). Beside "
    "it the preset `paper`, which sees numbers, and explores for as long as `image` does. A trial ends at its first "
    "greedy episode at the optimum.",
    "parts": "The main agent chooses a material before each of the design's parts. The arm `nested, tuned` ends each "
    "trial at its first greedy episode at the optimum; the other agents have the preset `paper`.",
    "materials": "One design, with 2, 4 and 8 materials, whose p are evenly spaced between the paper's two: the "
    "optimum is the same. Every agent does one update for each step that it trains, and its main agent one for each "
    "episode: so equal steps are nearly equal updates. Below, scores within what every trial of all nine had spent in "
    "the end; the claims compare two agents each, within what both had spent.",
    "cooperation": "Several builders in one arena, preset `paper`, with half its episodes. shared: one nested agent "
    "plays all of them; own: each has one; single: independent single agents. An episode of several builders is "
    "shorter, since they share the blocks.",
}

MORE = """\
- The trials that would decide a claim are so many that its tests would decide it with a power of {power:g}, if means,
  spreads and shares were what these trials had: all lines shown, or the opposite of one, at α divided by the number of
  lines. An estimate from few trials is rough, and so is this.
- A difference of differences has no permutation that leaves it as it was: (l) is tested by Welch and Satterthwaite's t.
- The states "screen" are not among these: they need a game's window."""


def beyond_text(arms: Arms, claims: Sequence[JudgedClaim], trials: int, seed: int) -> str:
    """The report as Markdown. The same results give the same text, but for the column of seconds."""
    of = f"{trials} trials" if trials > 1 else "one trial"
    parts = [
        "# Beyond the paper: what it says it could do, tried",
        f"Seed {seed}: {of} of each agent, where the tables don't say otherwise.",
        "![Images, parts, many main actions and cooperation](beyond.png)",
        _verdicts(claims),
    ]
    for topic, title in TOPICS.items():
        own = of_topic(arms, topic)
        parts += [f"## {title}", ABOUT[topic], *_too_few(own), _scores(own), *_more(arms, topic)]
        parts += [claim_section(each) for each in claims if each.claim.letter.startswith(LETTERS[topic])]
    parts += [
        "## How it was computed",
        method(claims, trials, keeps_best=False),
        MORE.format(power=POWER),
    ]
    return "\n\n".join(parts) + "\n"


def trials_to_decide(judged: JudgedClaim) -> int | None:
    """How many trials of each agent would decide the claim; None where more than MOST_TRIALS, or it is counted."""
    return deciding_trials([line.effect for line in judged.claim.evidence if line.effect])


def in_words(judged: JudgedClaim) -> str:
    """The same for a reader."""
    if not any(line.tails for line in judged.claim.evidence):
        return NONE
    found = trials_to_decide(judged)
    return f"more than {MOST_TRIALS:,}" if found is None else str(found)


def _too_few(arms: Sequence[ArmResults]) -> list[str]:
    """What so few trials can't show, where an arm has fewer than the binomial test needs."""
    few = min(len(arm.trials) for arm in arms)
    if few == max(len(arm.trials) for arm in arms) or 0.5**few < ALPHA:
        return []
    return [f"{few} trials are too few for any test: a claim with a line of so few stays undecided."]


def _verdicts(claims: Sequence[JudgedClaim]) -> str:
    rows = [
        (f"({each.claim.letter})", each.claim.title, f"**{each.verdict.value}**", in_words(each)) for each in claims
    ]
    header = ("claim", "", f"verdict at α = {ALPHA:g}", f"trials that would decide it, power {POWER:g}")
    return table(header, rows)


def _scores(arms: Sequence[ArmResults]) -> str:
    rows = [
        (
            arm.scenario,
            arm.name,
            str(len(arm.trials)),
            f"{arm.episodes:,}",
            *((NONE, NONE) if arm.stops else _mean_and_interval(arm.last_ten, arm.optimum)),
            *_mean_and_interval(arm.best, arm.optimum),
            *_reached(arm),
        )
        for arm in arms
    ]
    header = (
        "scenario",
        "agent",
        "trials",
        "episodes at most",
        "last ten",
        "95 % interval",
        "best",
        "95 % interval",
        "trials that reached the optimum",
        "95 % interval of the share",
        "episodes before, median",
    )
    optimum = ", ".join(dict.fromkeys(f"{arm.scenario} {arm.optimum:g}" for arm in arms))
    ends = " A trial that ends at the optimum has no last ten." if any(arm.stops for arm in arms) else ""
    return f"{table(header, rows)}\n\nOptimum: {optimum}.{ends}"


def _mean_and_interval(trials: Float64s, optimum: float) -> tuple[str, str]:
    return mean(trials), interval(mean_interval(trials, optimum))


def _reached(arm: ArmResults) -> tuple[str, str, str]:
    reached = [episode for episode in arm.episodes_to_optimum if episode is not None]
    share = interval(share_interval(len(reached), len(arm.trials)))
    return f"{len(reached)} of {len(arm.trials)}", share, f"{np.median(reached):g}" if reached else NONE


def _more(arms: Arms, topic: str) -> list[str]:
    """A topic's further tables: of many main actions, the scores at equal steps and updates, and what each took."""
    if topic != "materials":
        return []
    own = of_topic(arms, topic)
    steps, updates = equal_budget(own, "steps"), equal_budget(own, "updates")
    rows = [
        (
            str(arm.materials),
            arm.name,
            *_mean_and_interval(arm.within(steps, "steps"), arm.optimum),
            *_mean_and_interval(arm.within(updates, "updates"), arm.optimum),
            mean(arm.early(steps, "steps")),
            str(arm.networks),
            f"{arm.parameters:,}",
            f"{arm.updates:,}",
            f"{arm.env_steps:,}",
            mean(np.array(arm.replay_bytes) / MEGA),
            f"{arm.seconds:.1f}",
        )
        for arm in own
    ]
    header = (
        "materials",
        "agent",
        f"last ten until {steps:,} steps",
        "95 % interval",
        f"last ten until {updates:,} updates",
        "95 % interval",
        "early",
        "networks",
        "parameters",
        "updates, all trials",
        "steps, all trials",
        "replays, MB a trial",
        "seconds of a core, all trials",
    )
    early = (
        f"Early: the mean over a trial's evaluations until {steps // 3:,} steps. Seconds are of the whole training, "
        "the simulator too; another run won't repeat them."
    )
    return [f"{table(header, rows)}\n\n{early}"]
