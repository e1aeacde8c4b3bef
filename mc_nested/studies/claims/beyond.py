"""The claims about what the paper didn't try.

(j) images, (k) parts, (l) many main actions, as materials, (m) cooperation, (n) many main actions, as objectives.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import get_args

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.studies.claims.arm_results import ArmResults, Arms, Budget
from mc_nested.studies.claims.contests import (
    HIERARCHICAL,
    MARGIN,
    NESTED,
    OUTPERFORMED,
    SINGLE,
    Pair,
    ahead_by_score,
    compared,
    paired,
)
from mc_nested.studies.inference import ahead, mostly, no_worse, share_interval
from mc_nested.studies.power import MeanEffect, ShareEffect
from mc_nested.studies.verdicts import Claim, Evidence, JudgedClaim, Verdict, judged

IMAGES = "This framework is also applicable with inputs of images"
MORE_THAN_ONE = (
    "in general, the main agent could take more than one action before passing the information down the "
    "the nested agent"
)
MANY = (
    "as the number of main agent actions increases, we believe the performance will increase as well, when comparing "
    "to the deep hierarchical framework and the deep non-hierarchical single agent framework"
)
MODELS = (
    "we only had to train two DDQN models, compared with three for the deep hierarchical framework (this value "
    "increases for each unique main agent action)"
)
IMPROVE = (
    "We are particularly interested in this problem since the convergence in multi-agent scenarios is not guaranteed "
    "and we believe the deep nested agent framework will be able to improve the current state-of-the-art results"
)
COOPERATING = "multi-agent scenarios where there are many nested agents that are cooperating with each other"

MOSTLY = "Exact binomial tests of the share of trials{of}. Holds: it is above one half. Does not hold: it is below."
ABOVE = (
    "Sign-flip tests of the mean difference, within pairs of trials, of the last ten evaluations. Holds: it is above "
    "0; by less than a block: it is also shown to be less. Does not hold: it is below 0."
)
NOT_BEHIND = (
    "Sign-flip tests of the mean difference, within pairs of trials, of the best greedy score. Holds: it is above -1 "
    "block. Does not hold: it is below. The paper names no measure; this is our reading of applicable."
)
GROWS = (
    "Nested's lead: the difference, within pairs of trials, of {measure}. Sign-flip tests of how much larger it is "
    "with the most main actions than with the fewest. Holds: the change is above 0. Does not hold: it is below."
)
LATE = "each trial's last ten evaluations until it had spent as many {of} as every trial of the two had in the end"
EARLY = "each trial's mean over its evaluations until a third of the {of} that every trial of the two had in the end"
GROWING = (
    "Counted, not tested. Holds: the hierarchy's are more with the most main actions than with the fewest, and "
    "nested's are not. Does not hold: otherwise."
)
PARTS_READ = " The paper names no task for it; a material for each part of a design is our reading."
CONVERGES_READ = " The paper leaves open whether they converge; this share is our reading of it."
TEAM_READ = " The paper doesn't say what it compares with; this is our reading."
EVER = ": those that score the optimum in a greedy episode at any time"
LAST = ": those whose last greedy episode scores the optimum"


def judge_beyond(arms: Arms) -> tuple[JudgedClaim, ...]:
    """Judge every claim about a topic that has arms."""
    topics = [(topic, claims) for topic, claims in CLAIMS.items() if of_topic(arms, topic)]
    return tuple(judged(claim) for topic, claims in topics for claim in claims(of_topic(arms, topic)))


def of_topic(arms: Arms, topic: str) -> list[ArmResults]:
    """Return the arms that are about it, in their order."""
    return [arm for arm in arms.values() if arm.topic == topic]


def teams_of(arms: Sequence[ArmResults], networks: Networks) -> dict[int, ArmResults]:
    """Return the teams whose builders learn in that way, by how many they are: two or more."""
    teams = {arm.arm.builders or 1: arm for arm in arms if arm.arm.networks == networks}
    return {count: arm for count, arm in teams.items() if count > 1}


def alone_among(arms: Sequence[ArmResults]) -> ArmResults:
    """Return the arm of one builder."""
    return next(arm for arm in arms if arm.arm.builders == 1)


def equal_budget(arms: Sequence[ArmResults], of: Budget) -> int:
    """Return what every trial of these had spent in the end."""
    return min(arm.least_cost(of) for arm in arms)


def _of_images(arms: Sequence[ArmResults]) -> list[Claim]:
    images, numbers = ([arm for arm in arms if arm.name == name] for name in ("images", "numbers"))
    return [
        Claim(
            "j1",
            "an agent that sees images reaches the optimum",
            IMAGES,
            "4.1",
            MOSTLY.format(of=EVER),
            tuple(mostly_at_the_optimum(arm.scenario, arm.optimum, arm.best) for arm in images),
        ),
        Claim(
            "j2",
            "an agent that sees images scores no less than one that sees numbers",
            IMAGES,
            "4.1",
            NOT_BEHIND,
            tuple(
                not_behind(f"{seen.scenario}, best score", ("images", "numbers"), (seen.best, counted.best))
                for seen, counted in zip(images, numbers, strict=True)
            ),
        ),
    ]


def _of_parts(arms: Sequence[ArmResults]) -> list[Claim]:
    solved = next(arm for arm in arms if arm.stops)
    nested, *against = (next(arm for arm in arms if arm.name == name) for name in (NESTED, HIERARCHICAL, SINGLE))
    return [
        Claim(
            "k1",
            "a main agent that chooses again for each part reaches the optimum, with the preset tuned",
            MORE_THAN_ONE,
            "4.1",
            MOSTLY.format(of=EVER) + PARTS_READ,
            (mostly_at_the_optimum(solved.scenario, solved.optimum, solved.best),),
        ),
        *(
            Claim(
                f"k{number}",
                f"nested is above {other.name} where the main agent chooses for each part",
                OUTPERFORMED,
                "5.2",
                ABOVE,
                (above(other.scenario, nested, other),),
            )
            for number, other in enumerate(against, start=2)
        ),
    ]


def _of_main_actions(letter: str, arms: Sequence[ArmResults]) -> list[Claim]:
    contests: list[tuple[str, Budget, bool]] = [
        *((other, of, False) for other in (HIERARCHICAL, SINGLE) for of in get_args(Budget)),
        *((other, "steps", True) for other in (HIERARCHICAL, SINGLE)),
    ]
    grown = [_grows(arms, f"{letter}{number}", *contest) for number, contest in enumerate(contests, start=1)]
    networks = Claim(
        f"{letter}{len(grown) + 1}",
        "the hierarchy's networks grow with the number of main actions, nested's don't",
        MODELS,
        "6",
        GROWING,
        (_networks(arms),),
    )
    return [*grown, networks]


def _grows(arms: Sequence[ArmResults], letter: str, other: str, of: Budget, is_early: bool) -> Claim:
    own = {(arm.name, arm.materials): arm for arm in arms if arm.name in (NESTED, other)}
    budget = equal_budget(list(own.values()), of)

    def measure(arm: ArmResults) -> Float64s:
        return arm.early(budget, of) if is_early else arm.within(budget, of)

    leads = {count: (measure(own[NESTED, count]), measure(own[other, count])) for _, count in own}
    when = "early" if is_early else "late"
    title = f"nested's lead on {other} grows with the number of main actions, {when}, at equal {of}"
    rule = GROWS.format(measure=(EARLY if is_early else LATE).format(of=of))
    return Claim(letter, title, MANY, "6", rule, (lead_grows(f"{NESTED} and {other}, equal {of}", leads),))


def _networks(arms: Sequence[ArmResults]) -> Evidence:
    own = {agent: [arm for arm in arms if arm.name == agent] for agent in (NESTED, HIERARCHICAL)}
    grows = {agent: of[-1].trials[0].networks > of[0].trials[0].networks for agent, of in own.items()}
    figures = tuple(
        (f"{agent} with {arm.materials}", arm.trials[0].networks) for agent, of in own.items() for arm in of
    )
    holds = grows[HIERARCHICAL] and not grows[NESTED]
    return Evidence("networks of a trial", figures, counted=Verdict.HOLDS if holds else Verdict.FAILS)


def _of_teams(arms: Sequence[ArmResults]) -> list[Claim]:
    alone = alone_among(arms)
    teams = {kind: list(teams_of(arms, kind).values()) for kind in NETWORKS}
    return [
        Claim(
            "m1",
            f"cooperating nested agents converge to the optimum within {alone.arm.preset.episodes:,} episodes",
            IMPROVE,
            "6",
            MOSTLY.format(of=LAST) + CONVERGES_READ,
            tuple(mostly_at_the_optimum(arm.name, arm.optimum, arm.final) for arm in teams["shared"]),
        ),
        _compared_teams("m2", "cooperating nested agents score above one builder", COOPERATING, teams["shared"], alone),
        *(
            _compared_teams(letter, f"nested agents {how} score above independent single agents", IMPROVE, *pair)
            for letter, how, pair in (
                ("m3", "that share their networks", (teams["shared"], teams["single"])),
                ("m4", "with networks of their own", (teams["own"], teams["single"])),
            )
        ),
    ]


CLAIMS: Mapping[str, Callable[[Sequence[ArmResults]], list[Claim]]] = {
    "images": _of_images,
    "parts": _of_parts,
    "materials": partial(_of_main_actions, "l"),
    "cooperation": _of_teams,
    "objectives": partial(_of_main_actions, "n"),
}
"""A topic's claims, of its arms."""


def _compared_teams(
    letter: str, title: str, paper: str, teams: Sequence[ArmResults], others: Sequence[ArmResults] | ArmResults
) -> Claim:
    beside = [others] * len(teams) if isinstance(others, ArmResults) else others
    pairs = zip(teams, beside, strict=True)
    lines = tuple(above(f"{team.name} and {other.name}", team, other) for team, other in pairs)
    return Claim(letter, title, paper, "6", ABOVE + TEAM_READ, lines)


def above(what: str, arm: ArmResults, other: ArmResults) -> Evidence:
    """Return whether the first scores above the second; the opposite is that it is below."""
    return compared(what, (arm.name, other.name), (arm.last_ten, other.last_ten), ahead_by_score, MeanEffect)


def not_behind(what: str, names: tuple[str, str], pair: Pair) -> Evidence:
    """Return whether the first scores less than a block below the second; the opposite is that it is further below."""
    return compared(
        what,
        names,
        pair,
        partial(no_worse, margin=MARGIN),
        lambda difference, spread: MeanEffect(difference + MARGIN, spread),
    )


def mostly_at_the_optimum(what: str, optimum: float, scores: Float64s) -> Evidence:
    """Return whether a trial is more likely than not to score the optimum."""
    reached, trials = int((scores >= optimum).sum()), len(scores)
    figures = (("trials", trials), ("share at the optimum", reached / trials))
    return Evidence(
        what, figures, share_interval(reached, trials), mostly(reached, trials), effect=ShareEffect(reached / trials)
    )


def lead_grows(what: str, leads: Mapping[int, Pair]) -> Evidence:
    """Return whether the first's lead on the second is larger at the highest of these numbers than at the lowest."""
    within = {number: np.subtract(*paired(pair)) for number, pair in leads.items()}
    names = f"lead with {max(leads)}", f"lead with {min(leads)}"
    return compared(what, names, (within[max(leads)], within[min(leads)]), ahead, MeanEffect)
