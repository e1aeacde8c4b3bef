"""Engines of both kinds with the same first parameters, and batches for them."""

import numpy as np

from mc_nested.learn.dqn.engine import Batch, Engine, UpdateRule
from mc_nested.learn.dqn.engines import EngineChoice, made_engine
from mc_nested.learn.dqn.states import StateSpace

RULE = UpdateRule(batch=32, learning_rate=1e-3, target_period=3, huber_delta=1.0, margin=0.5)
GAMMA = 0.95
STATES = 15 * 15 * 12 * 2
HIDDEN = (32, 32)


def space_of(rows: int) -> StateSpace:
    """Return the nested agent's states on the line: x, y, b and a_M."""
    return StateSpace(np.array([[14, 14, 11, 1]] * rows), actions=8)


def engine_of(name: str, rows: int, rule: UpdateRule = RULE) -> Engine:
    """Return an engine of the paper's networks; those of a row are the same in every engine."""
    streams = [np.random.default_rng(row) for row in range(rows)]
    return made_engine(space_of(rows), EngineChoice(name, "cpu", "mlp", HIDDEN), rule, streams)


def batch_of(rows: int, seed: int) -> Batch:
    """Return a random batch for that many rows.

    Some rewards are far beyond δ, so that both branches of the Huber loss are taken.
    """
    random = np.random.default_rng(seed)
    return Batch(
        states=random.integers(0, STATES, (2, rows, 32)),
        actions=random.integers(0, 8, (rows, 32)),
        rewards=(random.standard_normal((rows, 32)) * 3).astype(np.float32),
        discounts=np.where(random.random((rows, 32)) < 0.2, 0.0, GAMMA).astype(np.float32),
        imitated=random.random((rows, 32)) < 0.3,
        weights=random.random((rows, 32)).astype(np.float32),
    )


def part(batch: Batch, rows: list[int]) -> Batch:
    """Return the named rows of a batch."""
    rest = {name: getattr(batch, name)[rows] for name in ("actions", "rewards", "discounts", "imitated", "weights")}
    return Batch(states=np.ascontiguousarray(batch.states[:, rows]), **rest)  # as a replay's are: compiled once
