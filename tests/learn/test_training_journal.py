"""A training's journal: what was added since a mark, and nothing twice."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.training_journal import TrainingJournal


class Counts:
    """An agent whose transitions are numbers."""

    def __init__(self) -> None:
        self.held: list[int] = []

    def marks(self) -> Arrays:
        return {"added": np.array([len(self.held)])}

    def transitions_since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        return {"held": np.array(self.held[int(marks["added"][0]) if marks else 0 :])}

    def store_again(self, transitions: Mapping[str, NDArray[Any]]) -> None:
        self.held += transitions["held"].tolist()


PLAYED = [EpisodeRow(0, episode, 3.0, 1, 9, 0.5, 0.25) for episode in (1, 2, 3)]
GREEDY = EvaluationRow(0, 2, 4.0, 1, 7)


def test_parts_of_it_put_together_are_all_of_it() -> None:
    agent, copy = Counts(), Counts()
    journal, again = TrainingJournal(agent), TrainingJournal(copy)
    journal.episodes.append(PLAYED[0])
    agent.held += [5, 6]
    parts, marks = [journal.since(None)], journal.marks()
    journal.episodes += PLAYED[1:]
    journal.evaluations.append(GREEDY)
    agent.held.append(7)
    parts.append(journal.since(marks))
    assert len(parts[1]["rows.episodes"]) == 2, "what was there at the marks isn't written again"
    for part in parts:
        again.extend(part)
    assert (again.episodes, again.evaluations, copy.held) == (PLAYED, [GREEDY], [5, 6, 7])
