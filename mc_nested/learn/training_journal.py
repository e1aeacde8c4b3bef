"""A training's journal: what only grows, a row for each finished episode and the transitions of an agent's replays."""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow, rows_of_table, table_of_rows
from mc_nested.learn.state_dict import named_for, part_of


class Remembers(Protocol):
    """An agent whose replays are in the journal (agents.py, cooperation/team_agent.py)."""

    def marks(self) -> Arrays:
        """Where its transitions end now."""

    def transitions_since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """Its transitions since those marks; all of them if there are none."""

    def store_again(self, transitions: Mapping[str, NDArray[Any]]) -> None:
        """Store what ``transitions_since`` returned."""


class TrainingJournal:
    """The rows of training episodes and of greedy evaluations, beside the agent's transitions."""

    def __init__(self, agent: Remembers) -> None:
        self.episodes: list[EpisodeRow] = []
        self.evaluations: list[EvaluationRow] = []
        self._agent = agent

    def marks(self) -> Arrays:
        """Its length now: how many rows there are, and how many transitions."""
        rows = np.array([len(self.episodes), len(self.evaluations)])
        return {"rows": rows, **named_for("agent", self._agent.marks())}

    def since(self, marks: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """The rows and transitions since those marks; all of them if there are none."""
        episodes, evaluations = marks["rows"] if marks else (0, 0)
        return {
            "rows.episodes": table_of_rows(self.episodes[episodes:], EpisodeRow),
            "rows.evaluations": table_of_rows(self.evaluations[evaluations:], EvaluationRow),
            **named_for("agent", self._agent.transitions_since(part_of(marks, "agent") if marks else None)),
        }

    def extend(self, added: Mapping[str, NDArray[Any]]) -> None:
        """Add what ``since`` returned; KeyError or ValueError if the shape differs."""
        self.episodes += rows_of_table(added["rows.episodes"], EpisodeRow)
        self.evaluations += rows_of_table(added["rows.evaluations"], EvaluationRow)
        self._agent.store_again(part_of(added, "agent"))
