"""What the claims about the paper's agents rest on: their greedy evaluations and costs on some scenarios."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.rules import PLACES, front_of, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import THE_ARENA, Tally
from mc_nested.studies.measures import Curve, curve_of
from mc_nested.studies.trial import Trial, on_each


class Cost(NamedTuple):
    """The costs of an agent's trials on a scenario.

    ``networks`` and ``parameters`` are those of one trial; ``updates``, ``env_steps`` and ``seconds`` are summed over
    all its trials. Seconds are their share where others were trained at once.
    ``replay_bytes``: of what each trial's replays hold at its end; empty where it wasn't measured.
    """

    networks: int
    parameters: int
    updates: int
    env_steps: int
    seconds: float
    replay_bytes: tuple[int, ...] = ()


@dataclass(frozen=True)
class Results:
    """An experiment: agents x scenarios x trials, all trained in the same way.

    Args:
        agents: of nested, hierarchical and single, those that were trained.
        scenarios: their names, in the order of the panels.
        trials: of each agent on each scenario.
        episodes: of training in a trial.
        evaluate_every: episodes between two greedy evaluations.
        seed: of the experiment.
        preset: its name.
        keeps_best: whether a trial keeps its best policy, not its last: what its final score is then.
        optimum: each scenario's highest score.
        builder: each scenario's score of the scripted builder.
        curves: the greedy scores of each agent on each scenario.
        costs: of each agent on each scenario.
    """

    agents: Sequence[str]
    scenarios: Sequence[str]
    trials: int
    episodes: int
    evaluate_every: int
    seed: int
    preset: str
    keeps_best: bool
    optimum: Mapping[str, float]
    builder: Mapping[str, float]
    curves: Mapping[tuple[str, str], Curve]
    costs: Mapping[tuple[str, str], Cost]


def results_of(trials: Sequence[Trial], seed: int) -> Results:
    """Return the results of some arms, one of each agent, that are trained in the same way on the same scenarios."""
    arm = trials[0].arm
    scenarios = {trial.scenario.name: trial.scenario for trial in trials}
    by_agent = {(own[0].arm.agent, scenario): own for (_, scenario), own in on_each(trials).items()}
    return Results(
        agents=list(dict.fromkeys(trial.arm.agent for trial in trials)),
        scenarios=list(scenarios),
        trials=arm.trials,
        episodes=arm.preset.episodes,
        evaluate_every=arm.preset.evaluate_every,
        seed=seed,
        preset=arm.short_preset,
        keeps_best=arm.preset.keep == "best",
        optimum={name: scenario.optimum for name, scenario in scenarios.items()},
        builder={name: builders_score(scenario) for name, scenario in scenarios.items()},
        curves={key: curve_of(own) for key, own in by_agent.items()},
        costs={key: _cost(own) for key, own in by_agent.items()},
    )


def _cost(trials: Sequence[Trial]) -> Cost:
    held = [trial.outcome.replay_bytes for trial in trials]
    return Cost(
        networks=trials[0].networks,
        parameters=trials[0].parameters,
        updates=sum(trial.outcome.updates for trial in trials),
        env_steps=sum(trial.outcome.env_steps for trial in trials),
        seconds=sum(trial.seconds for trial in trials),
        replay_bytes=() if None in held else tuple(count for count in held if count is not None),
    )


def builders_score(scenario: Scenario) -> float:
    """Return the scripted builder's score within the step limit, of the best material of each part, by the rules."""
    tally = Tally([scenario])
    cell, placed = scenario.start, set[Cell]()
    steps = build_with_materials(scenario)[: scenario.step_limit]
    tally.begin(THE_ARENA, np.array([steps[0][1]]))
    for action, material in steps:
        tally.take(THE_ARENA, np.array([material]))
        cell = moved(cell, action, placed, scenario.size)
        if action in PLACES:
            target = front_of(cell)
            tally.lay(THE_ARENA, np.array([target[0]]), np.array([target[1]]))
            placed.add(target)
    return float(tally.total(THE_ARENA)[0])
