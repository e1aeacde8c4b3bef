"""The table behind Figure 5: every greedy evaluation of every agent, scenario and trial, as results.csv."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from mc_nested.atomic_file import atomic_write
from mc_nested.errors import RunError


class Evaluation(NamedTuple):
    """One greedy episode after ``episode`` training episodes; trials count from 0, ``score`` is r_M."""

    agent: str
    scenario: str
    trial: int
    episode: int
    score: float
    material: str
    steps: int


class Cost(NamedTuple):
    """The costs of an agent's trials on a scenario.

    ``networks`` and ``parameters`` are those of one trial; ``updates``, ``env_steps`` and ``seconds`` are summed over
    all its trials. Seconds are their share where others were trained at once.
    ``replay_bytes``: of what each trial's replays hold at its end; empty where it wasn't measured.
    """

    agent: str
    scenario: str
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
        evaluations: of all trials, in any order.
        costs: one for each agent and scenario.
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
    evaluations: Sequence[Evaluation]
    costs: Sequence[Cost]


def write_evaluations(path: Path, evaluations: Iterable[Evaluation]) -> None:
    """Write them as CSV, atomically; OSError if the disk refuses."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Evaluation._fields)
        writer.writerows(evaluations)


def read_evaluations(path: Path) -> list[Evaluation]:
    """Exactly what was written; RunError if the file is missing or isn't such a table."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file)) or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise RunError(
            f"{path}: can't be read as a table of results ({error}): name the results.csv of a reproduce"
        ) from error
    if tuple(header) != Evaluation._fields:
        raise RunError(
            f"{path}: the first line isn't {','.join(Evaluation._fields)}: name the results.csv of a reproduce"
        )
    return [_evaluation(path, number, row) for number, row in enumerate(rows, start=1)]


def _evaluation(path: Path, number: int, row: Sequence[str]) -> Evaluation:
    try:
        agent, scenario, trial, episode, score, material, steps = row
        return Evaluation(agent, scenario, int(trial), int(episode), float(score), material, int(steps))
    except ValueError as error:
        raise RunError(f"{path}: row {number} isn't an evaluation ({error}): write the file again") from error
