"""Made-up results in which every measure of every trial is known."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from mc_nested.studies.results import Cost, Curve, Results

OPTIMUM = {"line": 21.0, "zigzag": 21.0, "diamond": 26.0, "hut": 15.0}
SECONDS = {"nested": 6.6, "hierarchical": 10.0, "single": 4.6}
REPLAY_BYTES = {"nested": 1_000_000, "hierarchical": 1_300_000, "single": 900_000}
NETWORKS = {"nested": 2, "hierarchical": 3, "single": 1}
PARAMETERS = {"nested": 3_000, "hierarchical": 4_500, "single": 1_500}
EPISODES = 90


class Trial(NamedTuple):
    """A trial's early score, final score and spread."""

    early: float
    final: float
    spread: float = 1.0


def made(trials: Mapping[tuple[str, str], Sequence[Trial]], episodes: int = EPISODES) -> Results:
    """Return results with nine evaluations a trial; agents and scenarios in the order of their first appearance."""
    every = episodes // 9
    at = np.arange(1, 10) * every
    scenarios = list(dict.fromkeys(scenario for _, scenario in trials))
    return Results(
        agents=list(dict.fromkeys(agent for agent, _ in trials)),
        scenarios=scenarios,
        trials=len(next(iter(trials.values()))),
        episodes=episodes,
        evaluate_every=every,
        seed=0,
        preset="paper",
        keeps_best=False,
        optimum={scenario: OPTIMUM[scenario] for scenario in scenarios},
        builder={scenario: OPTIMUM[scenario] for scenario in scenarios},
        curves={
            key: Curve(at, np.array([scores_of(trial) for trial in own]), episodes, False)
            for key, own in trials.items()
        },
        costs={
            (agent, scenario): Cost(
                NETWORKS[agent],
                PARAMETERS[agent],
                1200,
                1000,
                SECONDS[agent],
                tuple(REPLAY_BYTES[agent] + 1000 * trial for trial in range(len(own))),
            )
            for (agent, scenario), own in trials.items()
        },
    )


def scores_of(trial: Trial) -> list[float]:
    """Return nine scores, the late three around the final score, with the spread as their standard deviation."""
    early, final, spread = trial
    return [early] * 3 + [final] * 3 + [final + spread, final - spread, final]


def level(score: float, trials: int = 10, early: float = 5.0, spread: float = 1.0) -> list[Trial]:
    """Return trials whose final scores are ``score``, and an eighth of a block more or less in turn."""
    return [Trial(early, score + (0.125, -0.125)[trial % 2], spread) for trial in range(trials)]


def scattered(score: float, early: float = 5.0) -> list[Trial]:
    """Return trials from six blocks below ``score`` to six above: they decide little."""
    return [Trial(early + off, score + off, spread=4 + off / 2) for off in (-6, 6, -5, 5, -3, 3, -2, 2, -1, 1)]


def the_papers(*scenarios: str) -> dict[tuple[str, str], list[Trial]]:
    """Make ten trials of each agent on those scenarios, all where none is named, in which the paper's claims hold."""
    trials = {
        ("nested", "line"): level(20, early=12, spread=0.5),
        ("hierarchical", "line"): level(17, early=7, spread=1.5),
        ("single", "line"): level(13, early=2, spread=2),
        ("nested", "zigzag"): level(16, spread=0.5),
        ("hierarchical", "zigzag"): level(16, spread=1.5),
        ("single", "zigzag"): level(8, early=2, spread=2),
        ("nested", "diamond"): level(18, spread=0.5),
        ("hierarchical", "diamond"): level(18, spread=1.5),
        ("single", "diamond"): level(9, early=2, spread=2),
    }
    return {key: own for key, own in trials.items() if not scenarios or key[1] in scenarios}
