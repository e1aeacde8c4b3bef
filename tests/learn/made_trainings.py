"""Helpers for tests of trainings: a short preset, games that fail or slip, and a comparison of two trainings."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.arena.game import Following, Outcome, Resumable
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Int64s
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.training import Training
from sim.grid import GridGame, GridVectorEnv

PAPER = load_preset("paper")
SHORT = PAPER.model_copy(
    update={
        "episodes": 20,
        "evaluate_every": 5,
        "update": PAPER.update.model_copy(update={"batch": 8, "learning_starts": 16, "target_period": 50}),
    }
)


class StartsOver(GridGame):
    """A game that can't be saved half-way, like a live one, and that breaks down once where it is told to."""

    acts_left = -1
    error: Exception = ConnectionError("the game is gone")

    @property
    def resumable(self) -> Resumable | None:
        return None

    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        self.acts_left -= 1
        if self.acts_left == 0:
            raise self.error
        return super().act(action, material, following)


class Slips(GridVectorEnv):
    """Arenas in which a share of the actions is replaced by others."""

    def __init__(self, scenarios: Sequence[Scenario], share: float, seed: int) -> None:
        super().__init__(scenarios)
        self._share, self._random = share, np.random.default_rng(seed)

    def step(self, actions: Int64s) -> Any:
        slips = self._random.random(len(actions)) < self._share
        return super().step(np.where(slips, self._random.integers(0, 8, len(actions)), actions))


def ticked(trainer: Trainer, ticks: int) -> Trainer:
    for _ in range(ticks):
        trainer.tick()
    return trainer


def finish(trainer: Trainer) -> Trainer:
    while not trainer.finished:
        trainer.tick()
    return trainer


def copied(arrays: Arrays) -> Arrays:
    return {name: kept.copy() for name, kept in arrays.items()}


def saved(trainer: Training) -> tuple[Arrays, list[Arrays]]:
    """Return a training as it would be on disk."""
    return copied(trainer.state()), [trainer.journal(None)]


def assert_same(one: Training, other: Training) -> None:
    """Raise AssertionError unless both trainings came to the same, to the bit."""
    assert one.episode_rows == other.episode_rows
    assert one.evaluation_rows == other.evaluation_rows
    expected = other.state()
    for name, kept in one.state().items():
        np.testing.assert_array_equal(kept, expected.pop(name), err_msg=name)
    assert not expected
