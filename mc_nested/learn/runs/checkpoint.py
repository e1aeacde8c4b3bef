"""A training on disk: if the process is killed at any moment, the last save or the new one is there, whole.

``state.pt`` is rewritten at every save. What only grows (a replay's transitions, finished episodes) goes into a
journal, one more file per save, so that a save costs only what was added. Both hold torch tensors by name.
"""

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from pickle import UnpicklingError
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays
from mc_nested.atomic_file import atomic_write, remove_leftovers
from mc_nested.errors import RunError

FILE, WHOLE_JOURNAL = "state.pt", "journal.pt"

FORMAT = 1
"""Version of the files. A file without one was written before there were versions, and has this one."""

MOST_JOURNALS = 64
"""Journals kept side by side before they are merged into one."""


class Journalled(Protocol):
    """A training that can be saved: its state, and what was added since some earlier marks."""

    def state(self) -> Arrays: ...

    def marks(self) -> Arrays:
        """The length of the journal now, for ``journal``."""
        ...

    def journal(self, since: Mapping[str, NDArray[Any]] | None) -> Arrays:
        """What was added since those marks; everything if there are none."""
        ...

    def load(self, state: Mapping[str, NDArray[Any]], journals: list[Arrays]) -> None: ...


class Checkpoint:
    """The folder that one training is saved to and loaded from.

    Args:
        folder: its path; made at the first save.
        identity: what is trained; a checkpoint with another identity is refused.
    """

    def __init__(self, folder: Path, identity: Mapping[str, Any]) -> None:
        self._folder = folder
        self.identity = fingerprint(identity)
        self._journals: list[str] = []
        self._next = 0
        self._marks: Arrays | None = None

    @property
    def file(self) -> Path:
        """The file of the state; its identity is inside."""
        return self._folder / FILE

    @property
    def exists(self) -> bool:
        """Whether anything was ever saved."""
        return self.file.exists()

    def save(self, training: Journalled, finished: bool = False) -> None:
        """Save the training as it is now; OSError or RuntimeError if the disk refuses, the last save is intact then.

        The files of a finished training don't depend on how often it was saved and resumed.
        """
        self._folder.mkdir(parents=True, exist_ok=True)
        merge = finished or len(self._journals) >= MOST_JOURNALS
        name = WHOLE_JOURNAL if finished else f"journal-{self._next:06d}.pt"
        journals = [name] if merge else [*self._journals, name]
        self._write(name, training.journal(None if merge else self._marks), {})
        self._write(FILE, training.state(), {"format": FORMAT, "identity": self.identity, "journals": journals})
        for old in self._journals:
            if old not in journals:
                (self._folder / old).unlink(missing_ok=True)
        self._journals, self._next, self._marks = journals, self._next + 1, training.marks()

    def state(self) -> Arrays:
        """The last saved state; RunError if it is gone, damaged, newer or another training's, or torch is missing."""
        arrays: Arrays = self._open()["arrays"]
        return arrays

    def load_into(self, training: Journalled) -> None:
        """Continue the training from its last save; RunError as for ``state``."""
        found = self._open()
        journals = [self._read(name)["arrays"] for name in found["journals"]]
        try:
            training.load(found["arrays"], journals)
        except (KeyError, ValueError) as error:
            raise self._damaged(FILE) from error
        remove_leftovers(self._folder)
        self._journals, self._marks = found["journals"], training.marks()
        self._next = 1 + max((int(number) for name in self._journals if (number := name[8:-3]).isdigit()), default=-1)

    def _open(self) -> dict[str, Any]:
        if not self.exists:
            raise RunError(f"{self.file}: the checkpoint is gone: bring back a copy, or train again in a new folder")
        found = self._read(FILE)
        if found.get("format", FORMAT) > FORMAT:
            raise RunError(f"{self._folder / FILE}: written by a newer mc-nested: update mc-nested to open it")
        self.check_identity(found.get("identity"))
        return found

    def check_identity(self, found: str | None) -> None:
        """RunError unless that is the fingerprint of what is trained here."""
        if found != self.identity:
            raise RunError(
                f"{self.file}: the checkpoint belongs to another scenario, agent or preset than this run's "
                f"config.toml: put back the config.toml it was trained with"
            )

    def _write(self, name: str, arrays: Mapping[str, NDArray[Any]], beside: Mapping[str, Any]) -> None:
        import torch  # it takes 200 MB, which a process that only waits for others doesn't need

        # torch saves no two tensors of different types that begin at one address, as an empty array may beside another.
        own = {key: np.ascontiguousarray(kept) if kept.size else kept.copy() for key, kept in arrays.items()}
        tensors = {key: torch.from_numpy(kept) for key, kept in own.items()}
        with atomic_write(self._folder / name) as path, path.open("wb") as file:
            torch.save({**beside, "arrays": tensors}, file)

    def _read(self, name: str) -> dict[str, Any]:
        try:
            import torch
        except ImportError as error:
            raise RunError(f"{self._folder / name}: reading a checkpoint needs torch: install torch") from error
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
            f"again"
        )


def fingerprint(identity: Mapping[str, Any]) -> str:
    """A hash of the identity that doesn't depend on the order of its keys."""
    return hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()
