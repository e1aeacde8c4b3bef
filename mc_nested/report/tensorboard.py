"""TensorBoard events of a training: scores, ε, losses, values and updates a second, a run a folder.

Written where the extra is installed (``pip install mc-nested[tensorboard]``) and nowhere else. The events of a training
that was killed and resumed may be there twice from its last checkpoint on.
"""

import importlib.util
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from mc_nested.learn.training import Training

FOLDER = "tensorboard"
FILE = "events.out.tfevents.mc-nested"


def is_installed() -> bool:
    """Return whether TensorBoard is installed."""
    return importlib.util.find_spec("tensorboard") is not None


class TensorBoard:
    """Writes the figures of a trainer's runs at each of their greedy evaluations.

    Args:
        folders: each run's folder; made if it doesn't exist.
        trainer: its runs; evaluations from before count as written.
    """

    def __init__(self, folders: Sequence[Path], trainer: Training) -> None:
        self._trainer = trainer
        self._logs = [_Log(folder) for folder in folders]
        self._episodes, self._evaluations = len(trainer.episode_rows), len(trainer.evaluation_rows)
        self._recent: list[list[float]] = [[] for _ in folders]
        self._updates, self._at = trainer.agent.updates, time.monotonic()

    def write(self) -> None:
        """Write the evaluations since the last call; OSError if the disk refuses."""
        trainer = self._trainer
        evaluations = trainer.evaluation_rows[self._evaluations :]
        if not evaluations:
            return
        for episode in trainer.episode_rows[self._episodes :]:
            self._recent[episode.trial].append(episode.score)
        self._episodes, self._evaluations = len(trainer.episode_rows), len(trainer.evaluation_rows)
        epsilons, figures = trainer.epsilon, trainer.agent.last_figures()
        now, updates = time.monotonic(), trainer.agent.updates
        rate = (updates - self._updates) / max(now - self._at, 1e-9)
        self._updates, self._at = updates, now
        for row in evaluations:
            recent = self._recent[row.trial]
            scalars = {
                "score/greedy": row.score,
                "score/training": float(np.mean(recent)) if recent else np.nan,
                "epsilon/main": epsilons[0][row.trial],
                "epsilon/nested": epsilons[1][row.trial],
                "updates a second, all runs": rate,
                **{name: values[row.trial] for name, values in figures.items()},
            }
            recent.clear()
            self._logs[row.trial].add(row.episode, scalars)


class _Log:
    """One run's event file; opened for each event, since an experiment has more runs than a system may have files."""

    def __init__(self, folder: Path) -> None:
        from tensorboard.compat.proto.event_pb2 import Event

        self._path = folder / FILE
        folder.mkdir(parents=True, exist_ok=True)
        if not self._path.exists():
            self._append(Event(wall_time=time.time(), file_version="brain.Event:2"))

    def add(self, step: int, scalars: Mapping[str, Any]) -> None:
        from tensorboard.compat.proto.event_pb2 import Event
        from tensorboard.compat.proto.summary_pb2 import Summary

        values = [
            Summary.Value(tag=tag, simple_value=float(value)) for tag, value in scalars.items() if np.isfinite(value)
        ]
        self._append(Event(wall_time=time.time(), step=step, summary=Summary(value=values)))

    def _append(self, event: Any) -> None:
        from tensorboard.summary.writer.record_writer import RecordWriter

        with self._path.open("ab") as file:
            RecordWriter(file).write(event.SerializeToString())
