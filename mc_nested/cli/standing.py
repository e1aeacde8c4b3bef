"""How far an experiment's units are, from what their processes report."""

from collections.abc import Iterable

from mc_nested.cli.unit_process import Ended, Report
from mc_nested.learn.unit_training import UnitOutcome
from mc_nested.learn.units import Unit


class Standing:
    """Episodes, updates and recent scores of all units together.

    Args:
        units: all of them, with what came out of those that were finished before.
    """

    def __init__(self, units: Iterable[tuple[Unit, UnitOutcome | None]]) -> None:
        self._units: dict[str, Unit] = {}
        self._episodes: dict[str, int] = {}
        self._updates: dict[str, int] = {}
        self._updates_at_first: dict[str, int] = {}
        self._scores: dict[tuple[str, str], dict[int, float]] = {}
        self.optimum: dict[str, float] = {}
        """Each scenario's highest score, in the order of the scenarios."""
        self.groups: list[str] = []
        """Groups of which anything is known, those that trained last behind."""
        for unit, outcome in units:
            self._units[unit.name] = unit
            self.optimum.update({scenario.name: scenario.optimum for scenario in unit.scenarios})
            if outcome:
                self._episodes[unit.name] = unit.episodes
                self._take(unit, [run.evaluations[-1].score for run in outcome.runs])
        self.episodes_before = self.episodes
        """Episodes that were done before anything was heard."""

    @property
    def total(self) -> int:
        """Episodes of the whole experiment."""
        return sum(unit.episodes for unit in self._units.values())

    @property
    def episodes(self) -> int:
        """Episodes that are done."""
        return sum(self._episodes.values())

    @property
    def updates(self) -> int:
        """Updates since each unit was first heard of."""
        return sum(self._updates.values()) - sum(self._updates_at_first.values())

    def hear(self, heard: Report | Ended) -> None:
        """Take in what a process says."""
        unit = self._units[heard.unit]
        if isinstance(heard, Ended):
            if heard.finished:
                self._episodes[unit.name] = unit.episodes
            return
        if unit.name not in self._updates:
            self._updates_at_first[unit.name] = heard.updates
            self.episodes_before += sum(heard.episodes)
        self._episodes[unit.name] = sum(heard.episodes)
        self._updates[unit.name] = heard.updates
        self._take(unit, heard.scores)

    def score(self, group: str, scenario: str) -> float | None:
        """The mean over the runs, so far as they were evaluated, of the last greedy score."""
        scores = self._scores.get((group, scenario), {})
        return sum(scores.values()) / len(scores) if scores else None

    def _take(self, unit: Unit, scores: Iterable[float | None]) -> None:
        self.groups = [group for group in self.groups if group not in unit.groups] + list(dict.fromkeys(unit.groups))
        for group, scenario, trial, score in zip(unit.groups, unit.scenarios, unit.trials, scores, strict=True):
            if score is not None:
                self._scores.setdefault((group, scenario.name), {})[trial] = score
