"""A training on disk, written so that a kill at any moment leaves the last save or the new one, whole.

``state.pt`` is written anew at every save; what only grows (a replay's transitions, finished episodes) goes into a
journal, a file more a save, so that saving costs what was added, not what there is. Both hold torch tensors by name.
"""

import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.errors import RunError
from mc_nested.learn.whole_file import written_whole

Arrays = dict[str, NDArray[Any]]

FILE, WHOLE_JOURNAL = "state.pt", "journal.pt"

MOST_JOURNALS = 64
"""Journals that are kept side by side before they become one."""


class Journalled(Protocol):
    """A training that can be saved: its state, and what was added to it since certain marks."""

    def state(self) -> Arrays: ...

    def marks(self) -> Arrays:
        """Where the journal stands now, for ``journal``."""
        ...

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """What was added since those marks; everything, without them."""
        ...

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None: ...


class Checkpoint:
    """The folder that one training is saved to and brought back from.

    Args:
        folder: where; made at the first save.
        identity: what the training is; a checkpoint of another is refused.
    """

    def __init__(self, folder: Path, identity: Mapping[str, Any]) -> None:
        self._folder = folder
        self._identity = fingerprint(identity)
        self._journals: list[str] = []
        self._next = 0
        self._marks: Arrays | None = None

    @property
    def exists(self) -> bool:
        """Whether anything was ever saved."""
        return (self._folder / FILE).exists()

    def save(self, training: Journalled, finished: bool = False) -> None:
        """Save the training as it stands; OSError or RuntimeError where the disk refuses, the last save then intact.

        The files of a finished training are the same however often it was saved and brought back on the way.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        anew = finished or len(self._journals) >= MOST_JOURNALS
        name = WHOLE_JOURNAL if finished else f"journal-{self._next:06d}.pt"
        journals = [name] if anew else [*self._journals, name]
        self._write(name, training.journal(None if anew else self._marks), {})
        self._write(FILE, training.state(), {"identity": self._identity, "journals": journals})
        for old in self._journals:
            if old not in journals:
                (self._folder / old).unlink(missing_ok=True)
        self._journals, self._next, self._marks = journals, self._next + 1, training.marks()

    def state(self) -> Arrays:
        """The last saved state; RunError where there is none, where it is cut short, or belongs to something else."""
        arrays: Arrays = self._open()["arrays"]
        return arrays

    def load_into(self, training: Journalled) -> None:
        """Bring the training to where it was last saved; RunError as for ``state``."""
        found = self._open()
        journals = [self._read(name)["arrays"] for name in found["journals"]]
        try:
            training.load(found["arrays"], journals)
        except (KeyError, ValueError) as error:
            raise self._damaged(FILE) from error
        self._journals, self._marks = found["journals"], training.marks()
        self._next = 1 + max((int(number) for name in self._journals if (number := name[8:-3]).isdigit()), default=-1)

    def _open(self) -> dict[str, Any]:
        if not self.exists:
            raise RunError(f"{self._folder / FILE}: there is no checkpoint yet: train this run first")
        found = self._read(FILE)
        if found.get("identity") != self._identity:
            raise RunError(
                f"{self._folder / FILE}: the checkpoint belongs to another scenario, agent or preset than this run's "
                f"config.toml: put back the config.toml it was trained with"
            )
        return found

    def _write(self, name: str, arrays: Mapping[str, NDArray[Any]], beside: Mapping[str, Any]) -> None:
        import torch  # takes 200 MB, which a process that only waits for others can do without

        tensors = {key: torch.from_numpy(np.ascontiguousarray(kept)) for key, kept in arrays.items()}
        with written_whole(self._folder / name) as path, path.open("wb") as file:
            torch.save({**beside, "arrays": tensors}, file)
            file.flush()
            os.fsync(file.fileno())

    def _read(self, name: str) -> dict[str, Any]:
        import torch

        try:
            found = torch.load(self._folder / name, map_location="cpu", weights_only=True)
            return {**found, "arrays": {key: kept.numpy() for key, kept in found["arrays"].items()}}
        except (
            OSError,
            RuntimeError,
            EOFError,
            UnpicklingError,
            KeyError,
            TypeError,
            ValueError,
            AttributeError,
        ) as error:
            raise self._damaged(name) from error

    def _damaged(self, name: str) -> RunError:
        return RunError(
            f"{self._folder / name}: the checkpoint is damaged or cut short: bring back a whole copy, or train the run "
            f"anew"
        )


def fingerprint(identity: Mapping[str, Any]) -> str:
    """What the identity comes to, whatever the order of its keys."""
    return hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()


def part_of(state: Mapping[str, NDArray[Any]], whose: str) -> Arrays:
    """The entries of a saved state that belong to one of its parts, under the part's own names."""
    return {name.removeprefix(f"{whose}."): kept for name, kept in state.items() if name.startswith(f"{whose}.")}


def named_for(whose: str, state: Mapping[str, NDArray[Any]]) -> Arrays:
    """A part's entries under the names that ``part_of`` finds them by."""
    return {f"{whose}.{name}": kept for name, kept in state.items()}
