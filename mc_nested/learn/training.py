"""Training: what a run's folder, its summary and its views need of a training of agents, whoever trains."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.preset import Preset


class Training(Protocol):
    """R runs of an agent while they train: all in one process (trainer.py), or one with many games (games/)."""

    @property
    def agent(self) -> Agent:
        """What is trained."""

    @property
    def preset(self) -> Preset:
        """The hyper-parameters."""

    @property
    def env_steps(self) -> int:
        """Steps of training episodes so far, of all runs."""

    @property
    def evaluation_steps(self) -> int:
        """Steps of greedy evaluations so far, of all runs."""

    @property
    def episode_rows(self) -> list[EpisodeRow]:
        """A row for each finished training episode."""

    @property
    def evaluation_rows(self) -> list[EvaluationRow]:
        """A row for each greedy evaluation."""

    @property
    def finished(self) -> bool:
        """Whether every run is finished."""

    @property
    def episodes_done(self) -> Int64s:
        """Training episodes completed, (runs,)."""

    @property
    def runs_finished(self) -> Bools:
        """Which runs are finished, (runs,)."""

    @property
    def kept_scores(self) -> Float64s:
        """The greedy score of the policy that each run keeps, (runs,); -inf before the first evaluation."""

    @property
    def kept(self) -> Arrays:
        """The networks of the policies that the runs keep, by role, and their ``scores``: what plays afterwards."""

    @property
    def epsilon(self) -> tuple[Float64s, Float64s]:
        """The main and the nested agent's ε of the training episodes now, (runs,) each."""

    @property
    def imagination(self) -> Imagination | None:
        """What the runs have learnt of their games; None if the preset has no [imagination]."""

    def begin_from(self, online: Mapping[str, NDArray[Any]], *, evaluated_first: bool = True) -> None:
        """Begin with one run's networks, by role, in every run; evaluated before the first episode if so wished."""

    def state(self) -> Arrays:
        """What the rest of the training depends on, without the journal."""

    def marks(self) -> Arrays:
        """The length of the journal now: how many rows there are, and how many transitions."""

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """The rows and transitions since those marks; all of them if there are none."""

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        """Continue from what ``state`` and ``journal`` returned; KeyError or ValueError if the shape differs."""
