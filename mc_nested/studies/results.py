"""What the claims about the paper's agents rest on: their greedy evaluations and costs on some scenarios.

Of a trial are measured its early score, its final score, the mean of its last ten, and its late spread.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build_with_materials
from mc_nested.arena.rules import PLACES, front_of, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.tally import THE_ARENA, Tally
from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.report.curve import align_trials
from mc_nested.studies.trial import Trial, on_each

EARLY_EPISODES = 1000
"""Early is the first 1,000 episodes, or the first third of a training of fewer than 3,000."""


LAST = 10
"""Evaluations whose mean stands beside the final score, which is a single one."""


def early_limit(episodes: int) -> int:
    """Return the last episode that counts as early in a training of that many."""
    return min(EARLY_EPISODES, episodes // 3)


@dataclass(frozen=True)
class Curve:
    """The greedy scores of an agent on a scenario.

    Args:
        episodes: training episodes before each evaluation, (evaluations,).
        scores: greedy scores, (trials, evaluations).
        trained: episodes of the whole training.
        keeps_best: whether the policy kept is the best, not the last.
    """

    episodes: Int64s
    scores: Float64s
    trained: int
    keeps_best: bool

    @property
    def final(self) -> Float64s:
        """The score of each trial's policy, the last or the best, (trials,); empty where not every was evaluated."""
        if not len(self.episodes):
            return np.empty(0)
        best: Float64s = self.scores.max(axis=1)
        return best if self.keeps_best else self.scores[:, -1]

    @property
    def last_ten(self) -> Float64s:
        """Each trial's mean over the last ten evaluations, (trials,); empty where none is late.

        Over those of the last third of the training where they are fewer.
        """
        late = self.scores[:, self._late()][:, -LAST:]
        return late.mean(axis=1) if late.shape[1] else np.empty(0)

    @property
    def early(self) -> Float64s:
        """Each trial's mean score over the early evaluations, (trials,); empty where there are none."""
        early = self.episodes <= early_limit(self.trained)
        return self.scores[:, early].mean(axis=1) if early.any() else np.empty(0)

    @property
    def spread(self) -> Float64s:
        """Each trial's standard deviation over the evaluations of the last third; empty where there are not two."""
        late = self._late()
        return self.scores[:, late].std(axis=1, ddof=1) if late.sum() > 1 else np.empty(0)

    def _late(self) -> Bools:
        return 3 * self.episodes > 2 * self.trained


def curve_of(trials: Sequence[Trial]) -> Curve:
    """Return the curve of an arm's trials on a scenario."""
    preset = trials[0].arm.preset
    rows = [(trial.number, row.episode, row.score) for trial in trials for row in trial.outcome.evaluations]
    episodes, scores = align_trials(rows, len(trials))
    return Curve(np.array(episodes, dtype=np.int64), scores, preset.episodes, preset.keep == "best")


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
        costs={key: cost_of(own) for key, own in by_agent.items()},
    )


def cost_of(trials: Sequence[Trial]) -> Cost:
    """Return the costs of an arm's trials on a scenario."""
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
